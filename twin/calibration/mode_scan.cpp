#include "twin/calibration/mode_scan.h"
#include "core/process/parallel.h"
#include "twin/calibration/calibration_parts.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double weak_share  = 1.0 / 6;  // sd of ln w over the damping ratio: noise reaches half of such a peak
constexpr double prior_reach = 2.5;      // prior sd of ln w
constexpr int most_steps     = 60;       // to each side
constexpr double given_up    = 400;      // deviance beyond which nothing allowed follows
constexpr double chance      = 0.05;     // that noise looks like the resonance at any of all places
constexpr double hold        = 0.02;     // of a step, to which the frequency is held
constexpr double lower_by    = 0.5;      // of the cost: a minimum that is worth another scan

/// What a walk along a mode needs.
struct ModeWalk {
  const FittedStand &stand;
  const std::vector<Unknown> &stand_unknowns;
  const FitProblem &problem;
  const Fit &fit;
  Eigen::Index mode;
  double step;  // ln w
  int steps;
};

struct Place {
  double frequency;  // rad/s
  double deviance;
  Eigen::VectorXd theta;
};

/// ln w of the mode, and (p) its slope; zero for what does not move the stand.
struct LogFrequency {
  double value;
  Eigen::VectorXd slope;
};

LogFrequency log_frequency(const ModeWalk &walk, const Eigen::VectorXd &theta)
{
  const auto p        = Eigen::Index(walk.stand_unknowns.size());
  const StandAt there = stand_at(walk.stand, walk.stand_unknowns, theta.head(p));
  LogFrequency at_mode{std::log(there.frequency[walk.mode]), Eigen::VectorXd::Zero(theta.size())};
  at_mode.slope.head(p) = frequency_slopes(there).row(walk.mode).transpose();
  return at_mode;
}

/// The likelihood with ln w held at a place.
Objective held_at(const ModeWalk &walk, const double place)
{
  const double weight = 1 / std::pow(hold * walk.step, 2);
  return [&walk, place, weight](const Eigen::VectorXd &theta, const Wanted wanted) {
    Likelihood sum          = walk.problem.likelihood(theta, walk.fit.noise, wanted, 1);
    const LogFrequency here = log_frequency(walk, theta);
    const double away       = here.value - place;
    sum.cost += 0.5 * weight * away * away;
    if (sum.slope.size() > 0) {
      sum.slope += weight * away * here.slope;
      sum.information += weight * here.slope * here.slope.transpose();
    }
    return sum;
  };
}

/// Step by step away from the fit, each from the place before.
std::vector<Place> walked_places(const ModeWalk &walk, const double side)
{
  std::vector<Place> places;
  Eigen::VectorXd theta       = walk.fit.estimate;
  Eigen::MatrixXd information = walk.fit.information;
  for (int k = 0; k < walk.steps; ++k) {
    const LogFrequency here     = log_frequency(walk, theta);
    const Eigen::VectorXd cheap = posterior_covariance(information, walk.problem.unknowns) * here.slope;
    const Eigen::VectorXd start = theta + side * walk.step / here.slope.dot(cheap) * cheap;  // least change
    const double target         = here.value + side * walk.step;
    const Descent end           = descend(held_at(walk, target), walk.problem.unknowns, start, 40, 5e-3);
    theta                       = end.theta;
    const LogFrequency reached  = log_frequency(walk, theta);
    const double weight = 1 / std::pow(hold * walk.step, 2), away = reached.value - target;
    information = end.likelihood.information - weight * reached.slope * reached.slope.transpose();
    if (std::abs(away) > 0.5 * walk.step)  // a crossing of modes
      break;
    const double cost = end.likelihood.cost - 0.5 * weight * away * away;
    places.push_back({std::exp(reached.value), 2 * (cost - walk.fit.cost), theta});
    if (places.back().deviance > given_up)
      break;
  }
  return places;
}

ModeScan joined(const ModeWalk &walk, std::vector<Place> down, const std::vector<Place> &up, const StandAt &centre)
{
  std::reverse(down.begin(), down.end());
  down.push_back({centre.frequency[walk.mode], 0, walk.fit.estimate});
  down.insert(down.end(), up.begin(), up.end());
  std::sort(down.begin(), down.end(), [](const Place &a, const Place &b) { return a.frequency < b.frequency; });
  const auto q = Eigen::Index(down.size());
  ModeScan scan{walk.mode, 0, Eigen::VectorXd(q), Eigen::VectorXd(q), {}};
  for (Eigen::Index i = 0; i < q; ++i) {
    const Place &place = down[std::size_t(i)];
    scan.frequency[i]  = place.frequency;
    scan.deviance[i]   = place.deviance;
    scan.theta.push_back(place.theta);
  }
  const double widths = std::log(scan.frequency[q - 1] / scan.frequency[0]) / (2 * walk.step);
  scan.allowed        = std::max(other_basin, 2 * std::log(widths / chance));  // (45.11)
  return scan;
}

/// Free minima next to those of the scan; the lowest, where it is lower than the fit.
void look_for_lower(const ModeWalk &walk, const ModeScan &scan, const FitSettings &settings,
                    std::optional<Eigen::VectorXd> &lower)
{
  double lowest = walk.fit.cost - lower_by;
  for (const Eigen::Index i : minima_of(scan.deviance)) {
    if (scan.deviance[i] == 0 || scan.deviance[i] > scan.allowed)
      continue;
    const Fit free = minimised(walk.problem, scan.theta[std::size_t(i)], walk.fit.noise, settings);
    if (free.cost < lowest) {
      lowest = free.cost;
      lower  = free.estimate;
    }
  }
}
}  // namespace

bool ModeScan::has_several_places() const
{
  const auto minima = minima_of(deviance);
  return std::count_if(minima.begin(), minima.end(), [&](const Eigen::Index i) { return deviance[i] < allowed; }) >
         1;
}

std::vector<Eigen::Index> minima_of(const Eigen::VectorXd &deviance)
{
  std::vector<Eigen::Index> minima;
  for (Eigen::Index i = 0; i < deviance.size(); ++i) {
    const auto rises = [&](const Eigen::Index by) {
      double highest = deviance[i];
      for (Eigen::Index k = i + by; k >= 0 && k < deviance.size(); k += by) {
        highest = std::max(highest, deviance[k]);
        if (deviance[k] < deviance[i])
          return highest > deviance[i] + 1;
      }
      return true;  // an end of the scan: nothing lower on this side
    };
    // a fall that continues beyond the end of the scan is not a minimum
    const bool inside = i > 0 && i + 1 < deviance.size();
    if (inside && rises(-1) && rises(1))
      minima.push_back(i);
  }
  return minima;
}

std::vector<ModeScan> scanned_modes(const FittedStand &stand, const FitProblem &problem, const Fit &fit,
                                    const std::vector<Unknown> &stand_unknowns, const double highest,
                                    const FitSettings &settings, std::optional<Eigen::VectorXd> &lower)
{
  std::vector<ModeScan> scans;
  const auto p         = Eigen::Index(stand_unknowns.size());
  const StandAt centre = stand_at(stand, stand_unknowns, fit.estimate.head(p));
  const auto slopes    = frequency_slopes(centre);
  for (Eigen::Index i = 0; i < centre.frequency.size() && centre.frequency[i] < 2 * M_PI * highest; ++i) {
    const Eigen::VectorXd slope = slopes.row(i).transpose();
    const double sd             = std::sqrt(std::max(0.0, slope.dot(fit.covariance.topLeftCorner(p, p) * slope)));
    double prior                = 0;
    for (Eigen::Index k = 0; k < p; ++k)
      prior += std::pow(slope[k] * stand_unknowns[std::size_t(k)].prior_sd, 2);
    prior             = std::sqrt(prior);
    const double step = centre.damping[i];
    if (!(sd > weak_share * step) || !std::isfinite(prior))
      continue;
    const ModeWalk walk{stand,
                        stand_unknowns,
                        problem,
                        fit,
                        i,
                        step,
                        std::min(most_steps, int(std::ceil(prior_reach * prior / step)))};
    std::vector<Place> sides[2];
    share_tasks(2, settings.threads,
                [&](const long side) { sides[side] = walked_places(walk, side == 0 ? -1 : 1); });
    scans.push_back(joined(walk, sides[0], sides[1], centre));
    look_for_lower(walk, scans.back(), settings, lower);
  }
  return scans;
}
}  // namespace mill::twin
