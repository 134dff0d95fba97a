#include "twin/calibration/second_minima.h"
#include "twin/calibration/calibration_parts.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double widths_of_sd = 2 * 1.96;  // of a 95 % interval

/// Furthest of the first p unknowns from its prior, in its deviations.
double furthest(const std::vector<Unknown> &unknowns, const Eigen::Index p, const Eigen::VectorXd &theta)
{
  double most = 0;
  for (Eigen::Index i = 0; i < p; ++i)
    most = std::max(most, std::abs(theta[i] - unknowns[std::size_t(i)].prior) / unknowns[std::size_t(i)].prior_sd);
  return most;
}

Eigen::Index index_of(const ScannedFit &scan, const std::string &name)
{
  const auto &all = scan.best.unknowns;
  return std::find_if(all.begin(), all.end(), [&](const Unknown &u) { return u.name == name; }) - all.begin();
}

Eigen::MatrixXd covering(const ScannedFit &scan)
{
  Eigen::MatrixXd interval = scan.interval;
  const auto cover         = [&](const Eigen::Index i, const double value) {
    interval(i, 0) = std::min(interval(i, 0), value);
    interval(i, 1) = std::max(interval(i, 1), value);
  };
  for (Eigen::Index i = 0; i < interval.rows(); ++i) {
    for (const Eigen::VectorXd &end : scan.ends)
      cover(i, end[i]);
    for (const Basin &basin : scan.basins)
      if (basin.deviance < other_basin && i != index_of(scan, basin.name))
        cover(i, basin.unknowns[i]);
  }
  return interval;
}
/// Width of the part of a profile below deviance 9, ends between its points by straight lines.
double width_below(const Profile &profile, const double deviance)
{
  const Eigen::VectorXd &d = profile.deviance, &x = profile.theta;
  Eigen::Index first = 0, last = d.size() - 1;
  while (first < last && d[first] >= deviance)
    ++first;
  while (last > first && d[last] >= deviance)
    --last;
  if (d[first] >= deviance)
    return 0;
  double from = x[first], to = x[last];
  if (first > 0)
    from -= (x[first] - x[first - 1]) * (deviance - d[first]) / (d[first - 1] - d[first]);
  if (last + 1 < d.size())
    to += (x[last + 1] - x[last]) * (deviance - d[last]) / (d[last + 1] - d[last]);
  return to - from;
}
}  // namespace

void prefer_a_correction(const FitProblem &problem, const Eigen::Index p, const FitSettings &settings,
                         ScannedFit &scan)
{
  const Fit beyond = scan.best;
  if (furthest(beyond.unknowns, p, beyond.estimate) <= far_from_prior)
    return;
  const auto second = std::find_if(scan.basins.begin(), scan.basins.end(), [&](const Basin &basin) {
    return basin.deviance < other_basin && furthest(beyond.unknowns, p, basin.unknowns) <= far_from_prior;
  });
  if (second == scan.basins.end())
    return;
  const std::string name   = second->name;
  scan.best                = minimised(problem, second->unknowns, beyond.noise, settings);
  const double rise        = 2 * (scan.best.cost - beyond.cost);
  const Eigen::Index index = index_of(scan, name);
  std::vector<Basin> basins{{name, beyond.estimate[index], -rise, beyond.estimate}};
  for (Basin other : scan.basins) {
    other.deviance -= rise;
    if (other.name != name || std::abs(other.theta - scan.best.estimate[index]) > scan.best.sd()[index])
      basins.push_back(other);
  }
  scan.basins = std::move(basins);
  for (Profile &profile : scan.profiles)
    profile.deviance.array() -= rise;
  set_intervals(problem, settings, scan);
}

std::vector<Calibrated> judged_with_minima(const ScannedFit &scan)
{
  ScannedFit apart = scan;
  apart.interval   = covering(scan);
  apart.basins.clear();
  for (const Basin &basin : scan.basins)
    if (const Eigen::Index i = index_of(scan, basin.name);
        basin.theta < scan.interval(i, 0) || basin.theta > scan.interval(i, 1))
      apart.basins.push_back(basin);
  Eigen::VectorXd wide = (apart.interval.col(1) - apart.interval.col(0)) / widths_of_sd;
  // three deviations to both sides: a resonance that noise feigns is sharp at its top and nowhere else
  for (const Profile &profile : scan.profiles)
    if (const Eigen::Index i = index_of(scan, profile.name); i < wide.size())
      wide[i] = std::max(wide[i], width_below(profile, other_basin) / 6);
  return judged(apart, scan.best.sd().cwiseMax(wide));
}
}  // namespace mill::twin
