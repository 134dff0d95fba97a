#include "twin/calibration/basins.h"
#include "core/process/parallel.h"
#include <algorithm>
#include <cmath>
#include <mutex>

namespace mill::twin {
namespace {
constexpr Eigen::Index steps   = 17;
constexpr double half_width    = 2.5;   // prior sd
constexpr double worth_a_scan  = 0.01;  // sd over prior sd
constexpr double interval_rise = 3.84;  // chi-square of one, 95 %
constexpr double exact_below   = 200;   // deviance: profiles below it are of all bins
constexpr double lower_by      = 0.5;   // of the cost: a minimum that is worth another scan

struct Scan {
  const FitProblem &problem;
  const Fit &fit;
  FitSettings settings;
  Fit at(const Eigen::VectorXd &start, const Eigen::Index fixed) const
  {
    FitSettings each = settings;
    each.covariance  = fixed < 0;
    return minimised(problem, start, fit.noise, each, fixed);
  }
  double deviance(const Fit &other) const
  {
    return 2 * (other.cost - fit.cost);
  }
};

/// One walk over the grid: estimates and costs of every step.
struct Walk {
  std::vector<Eigen::VectorXd> theta;
  Eigen::VectorXd cost;
};

/// @param walked_problem  the problem of the scan or its groups of bins
Walk walked(const Scan &scan, const FitProblem &walked_problem, const Eigen::Index spring,
            const Eigen::VectorXd &grid, const bool upward)
{
  Walk walk{std::vector<Eigen::VectorXd>(std::size_t(steps)), Eigen::VectorXd(steps)};
  Eigen::VectorXd theta   = scan.fit.estimate;
  Scan quick              = {walked_problem, scan.fit, scan.settings};  // a hundredth of the deviance is enough
  quick.settings.decrease = 5e-3;
  quick.settings.steps    = 25;
  const Scan whole        = {scan.problem, scan.fit, quick.settings};
  const double above =
      scan.fit.cost -
      walked_problem.likelihood(scan.fit.estimate, scan.fit.noise, Wanted::cost, scan.settings.threads).cost;
  for (Eigen::Index i = 0; i < steps; ++i) {
    const Eigen::Index k = upward ? i : steps - 1 - i;
    theta[spring]        = grid[k];
    Fit refit            = quick.at(theta, spring);
    refit.cost += above;
    // groups lead to the minimum; where it matters all bins say how deep it is
    if (scan.deviance(refit) < exact_below)
      refit = whole.at(refit.estimate, spring);
    theta                      = refit.estimate;
    walk.theta[std::size_t(k)] = theta;
    walk.cost[k]               = refit.cost;
  }
  return walk;
}

Eigen::VectorXd grid_of(const Unknown &unknown)
{
  return Eigen::VectorXd::LinSpaced(steps, unknown.prior - half_width * unknown.prior_sd,
                                    unknown.prior + half_width * unknown.prior_sd);
}

/// Where the deviance reaches 3.84 on one side of the minimum, others fitted: secant of its root, which is
/// straight where the valley is.
Eigen::VectorXd end_of_interval(const Scan &scan, const Eigen::Index spring, const double side)
{
  const double centre = scan.fit.estimate[spring], wanted = std::sqrt(interval_rise);
  double reach = wanted * scan.fit.sd()[spring], inside = 0, inside_root = 0;
  Eigen::VectorXd theta = scan.fit.estimate;
  for (int step = 0; step < 12; ++step) {
    theta[spring]     = centre + side * reach;
    const Fit refit   = scan.at(theta, spring);
    const double root = std::sqrt(std::max(0.0, scan.deviance(refit)));
    if (std::abs(root - wanted) < 0.01 * wanted)
      return refit.estimate;
    double next = inside + (reach - inside) * (wanted - inside_root) / std::max(root - inside_root, 1e-6);
    if (root < wanted) {
      inside      = reach;
      inside_root = root;
      theta       = refit.estimate;
      next        = std::min(next, 3 * reach);
    } else
      next = std::max(next, inside + 0.1 * (reach - inside));
    reach = next;
  }
  theta[spring] = centre + side * reach;
  return theta;
}

/// A free minimum that a profile led to.
struct Candidate {
  Eigen::Index spring;
  Fit fit;
};

struct Scanned {
  std::vector<Profile> profiles;
  std::vector<Candidate> candidates;
};

Scanned scan_once(const Scan &scan, const std::vector<Eigen::Index> &springs, const int threads,
                  const std::function<void()> &one_done)
{
  FitProblem groups = scan.problem;
  if (groups.grouped)
    groups.likelihood = groups.grouped(scan.fit.estimate, scan.fit.noise);
  std::vector<Walk> walks(2 * springs.size());
  share_tasks(long(walks.size()), threads, [&](const long t) {
    const Eigen::Index spring = springs[std::size_t(t / 2)];
    walks[std::size_t(t)] =
        walked(scan, groups, spring, grid_of(scan.fit.unknowns[std::size_t(spring)]), t % 2 == 0);
    one_done();
  });
  Scanned result;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const Walk &up = walks[2 * s], &down = walks[2 * s + 1];
    const Unknown &unknown = scan.fit.unknowns[std::size_t(springs[s])];
    result.profiles.push_back(
        {unknown.name, grid_of(unknown), (2 * (up.cost.cwiseMin(down.cost).array() - scan.fit.cost)).matrix()});
    const Eigen::VectorXd &deviance = result.profiles.back().deviance;
    for (const Eigen::Index i : minima_of(deviance))
      if (deviance[i] < 100) {
        const Walk &lower = up.cost[i] < down.cost[i] ? up : down;
        result.candidates.push_back({springs[s], scan.at(lower.theta[std::size_t(i)], -1)});
      }
  }
  return result;
}

/// Lowest first, each once, without the best minimum.
std::vector<Basin> basins_of(const Fit &best, std::vector<Candidate> candidates, const Fit &first)
{
  std::vector<Basin> basins;
  for (const Candidate &c : candidates)
    for (const Fit *fit : {&c.fit, &first}) {
      const double step  = 2 * half_width * best.unknowns[std::size_t(c.spring)].prior_sd / double(steps - 1);
      const double theta = fit->estimate[c.spring];
      const bool known   = std::any_of(basins.begin(), basins.end(), [&](const Basin &b) {
        return b.name == best.unknowns[std::size_t(c.spring)].name && std::abs(b.theta - theta) < 0.5 * step;
      });
      if (!known && std::abs(theta - best.estimate[c.spring]) > 0.5 * step)
        basins.push_back(
            {best.unknowns[std::size_t(c.spring)].name, theta, 2 * (fit->cost - best.cost), fit->estimate});
    }
  std::sort(basins.begin(), basins.end(), [](const Basin &a, const Basin &b) { return a.deviance < b.deviance; });
  return basins;
}
}  // namespace

void set_intervals(const FitProblem &problem, const FitSettings &settings, ScannedFit &scan)
{
  const Eigen::VectorXd sd = scan.best.sd();
  scan.interval.resize(sd.size(), 2);
  scan.interval.col(0) = scan.best.estimate - 1.96 * sd;
  scan.interval.col(1) = scan.best.estimate + 1.96 * sd;
  std::vector<Eigen::Index> springs;
  for (const Profile &profile : scan.profiles)
    for (std::size_t i = 0; i < scan.best.unknowns.size(); ++i)
      if (scan.best.unknowns[i].name == profile.name)
        springs.push_back(Eigen::Index(i));
  scan.ends.assign(2 * springs.size(), scan.best.estimate);
  FitSettings single = settings;
  single.threads     = 1;  // the ends share the threads
  const Scan last{problem, scan.best, single};
  share_tasks(long(2 * springs.size()), settings.threads, [&](const long t) {
    const Eigen::Index spring    = springs[std::size_t(t / 2)];
    scan.ends[std::size_t(t)]    = end_of_interval(last, spring, t % 2 == 0 ? -1 : 1);
    scan.interval(spring, t % 2) = scan.ends[std::size_t(t)][spring];
  });
}

ScannedFit scanned(const FittedStand &stand, const Fit &first, const MeasuredResponse &data,
                   const FitSettings &settings, const std::function<void(double)> &progress)
{
  return scanned(recorded_force(stand, first.unknowns, data), first, settings, progress);
}

ScannedFit scanned(const FitProblem &problem, const Fit &first, const FitSettings &settings,
                   const std::function<void(double)> &progress)
{
  ScannedFit result{first, {}, {}, {}, {}, 0};
  FitSettings single = settings;
  single.threads     = 1;  // the walks share the threads
  std::vector<Eigen::Index> springs;
  for (;;) {
    springs.clear();
    const Eigen::VectorXd shrink = result.best.shrink();
    for (std::size_t i = 0; i < result.best.unknowns.size(); ++i)
      if (problem.is_spring(result.best.unknowns[i].name) && shrink[Eigen::Index(i)] > worth_a_scan)
        springs.push_back(Eigen::Index(i));
    const Fit scanned_fit = result.best;
    std::mutex guard;
    std::size_t done    = 0;
    const auto one_done = [&] {
      const std::lock_guard<std::mutex> lock(guard);
      if (progress)
        progress(double(++done) / double(2 * springs.size()));
    };
    const Scanned scan = scan_once({problem, scanned_fit, single}, springs, settings.threads, one_done);
    result.profiles    = scan.profiles;
    for (const Candidate &c : scan.candidates)
      if (c.fit.cost < result.best.cost)
        result.best = c.fit;
    const double lower = scanned_fit.cost - result.best.cost;
    if (lower < lower_by || result.starts_over == 3) {
      for (Profile &profile : result.profiles)
        profile.deviance.array() += 2 * lower;
      result.basins = basins_of(result.best, scan.candidates, scanned_fit);
      break;
    }
    result.best = fitted(problem, result.best.estimate, settings);
    ++result.starts_over;
  }
  set_intervals(problem, settings, result);
  return result;
}
}  // namespace mill::twin
