#include "dynamics/nonlinear/mode_study.h"
#include "core/base/errors.h"
#include "dynamics/nonlinear/harmonic_balance.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace mill::dynamics {
namespace {
constexpr int harmonics_kept = 9;
// A spring whose compression follows a mode less than this, relative to the one that follows it most, is not
// strained by rounding alone.
constexpr double no_strain = 1e-6;
// Amplitudes over the one at which the first spring would part if it were linear; the first is the tangent's.
constexpr double steps_of_amplitude[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.1, 1.2, 1.35, 1.5};

// kg^1/2 m, modal amplitude at which a linear spring would part, and which.
struct FirstToPart {
  double amplitude   = INFINITY;
  std::size_t spring = 0;
};
FirstToPart first_to_part(const CurveStand &stand, const std::size_t mode)
{
  FirstToPart first;
  for (std::size_t j = 0; j < stand.springs.size(); ++j) {
    const CurveSpring &spring = stand.springs[j];
    const double strain       = std::abs(spring.stiffness * spring.row[mode]);
    if (strain > 0 && spring.force / strain < first.amplitude)
      first = {spring.force / strain, j};
  }
  return first;
}

// Smallest force of any spring in a periodic motion over that at rest.
double least_force(const CurveStand &stand, const PeriodicMotion &motion)
{
  double least = 1;
  for (std::size_t j = 0; j < stand.springs.size(); ++j) {
    const CurveSpring &spring = stand.springs[j];
    const double force        = stand.laws[spring.law].at(motion.least[Eigen::Index(j)]).force;
    least                     = std::min(least, force / spring.force);
  }
  return least;
}

// -, smallest compression of any spring over that at rest: unlike the force it goes on below zero.
double least_compression(const CurveStand &stand, const PeriodicMotion &motion)
{
  double least = 1;
  for (std::size_t j = 0; j < stand.springs.size(); ++j)
    least = std::min(least, motion.least[Eigen::Index(j)] / stand.springs[j].rest);
  return least;
}

// The point of the first six that a mode moves most.
Eigen::Index mover_of(const ModalModel &model, const Eigen::Index mode)
{
  Eigen::Index most = 0;
  model.point.col(mode).head(std::min<Eigen::Index>(6, model.point.rows())).cwiseAbs().maxCoeff(&most);
  return most;
}

// y at x on straight lines through points in increasing x; beyond the last one the last.
double on_lines(const std::vector<double> &xs, const std::vector<double> &ys, const double x)
{
  for (std::size_t i = 1; i < xs.size(); ++i)
    if (x <= xs[i])
      return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys.back();
}

void follow_backbone(NonlinearMode &made, const CurveStand &stand, const Eigen::Index mode, const double moves,
                     const FirstToPart &first, const double run_peak)
{
  made.amplitude = {0};
  made.followed  = {made.frequency};
  made.least     = {1};
  PeriodicMotion before;
  double last_gap = 1, last_amplitude = 0, last_frequency = made.frequency;
  for (const double part : steps_of_amplitude) {
    const double amplitude = part * first.amplitude;
    PeriodicMotion motion =
        free_motion(stand, mode, amplitude, harmonics_kept, before.settled ? &before : nullptr);
    if (!motion.settled)
      break;
    made.amplitude.push_back(amplitude * moves);
    made.followed.push_back(motion.frequency);
    made.least.push_back(least_force(stand, motion));
    const double gap = least_compression(stand, motion);
    if (gap <= 0 && std::isnan(made.bend)) {  // between the last two, on a straight line
      const double t         = last_gap / (last_gap - gap);
      made.parting_amplitude = (last_amplitude + t * (amplitude - last_amplitude)) * moves;
      made.bend              = (last_frequency + t * (motion.frequency - last_frequency)) / made.frequency - 1;
    }
    last_gap       = gap;
    last_amplitude = amplitude;
    last_frequency = motion.frequency;
    before         = std::move(motion);
  }
  if (made.amplitude.size() > 1 && run_peak * moves <= made.amplitude.back()) {
    // Near zero a frequency goes with the square of the amplitude.
    const double there = run_peak * moves, ratio = there / made.amplitude[1];
    made.bend_in_run = (ratio < 1 ? made.frequency + ratio * ratio * (made.followed[1] - made.frequency)
                                  : on_lines(made.amplitude, made.followed, there)) /
                           made.frequency -
                       1;
  }
}

// N, force at the mode's frequency at which the smallest compression is zero: doubled or extended linearly until
// it is bracketed, then by false position.
double parting_force(const CurveStand &stand, const double frequency)
{
  PeriodicMotion motion = forced_motion(stand, frequency, 1, harmonics_kept);
  if (!motion.settled)
    return not_given;
  const double slope = 1 - least_compression(stand, motion);  // per newton
  if (!(slope > 0))
    return not_given;
  double low = 0, gap_low = 1, high = 0, gap_high = 0, force = 0.5 / slope;
  std::optional<PeriodicMotion> near;
  for (int round = 0; round < 40; ++round) {
    const PeriodicMotion next = forced_motion(stand, frequency, force, harmonics_kept, near ? &*near : nullptr);
    // Deep in separation the series may not settle: the force is too large then.
    if (!next.settled && !(low > 0))
      return not_given;
    const double gap = next.settled ? least_compression(stand, next) : -gap_low;
    if (std::abs(gap) < 1e-6)
      return force;
    if (gap > 0) {
      low     = force;
      gap_low = gap;
      near    = next;
    } else {
      high     = force;
      gap_high = gap;
    }
    const double straight = high > 0 ? low + (high - low) * gap_low / (gap_low - gap_high)
                                     : force * std::min(1.4, 1 / std::max(1e-9, 1 - gap));
    force                 = high > 0 && round % 4 == 3 ? 0.5 * (low + high) : straight;
    if (high > 0 && high - low < 1e-9 * high)
      return force;
  }
  return not_given;
}

// Work roll that moves most at f, 2f, 3f, m/s2.
std::vector<double> harmonics_of(const ModalModel &model, const PeriodicMotion &motion)
{
  std::vector<double> most;
  for (const Eigen::Index roll : {Eigen::Index(upper_work_roll), Eigen::Index(lower_work_roll)}) {
    std::vector<double> values;
    for (int h = 1; h <= 3; ++h) {
      const double w = 2 * M_PI * motion.frequency * h;
      values.push_back(
          w * w * std::abs((model.point.row(roll).cast<std::complex<double>>() * motion.modal.col(h)).value()));
    }
    if (most.empty() || values[0] > most[0])
      most = values;
  }
  return most;
}
}  // namespace

std::vector<NonlinearMode> mode_study(const CurveStand &stand, const ModalModel &model, const CurveRun &run,
                                      const double force, const double highest)
{
  std::vector<NonlinearMode> modes;
  double largest_strain = 0;
  const auto strain     = [&](const std::size_t k) {
    double most = 0;
    for (const CurveSpring &spring : stand.springs)
      most = std::max(most, std::abs(spring.row[k]));
    return most;
  };
  for (std::size_t k = 0; k < stand.modes(); ++k)
    largest_strain = std::max(largest_strain, strain(k));
  for (std::size_t k = 0; k < stand.modes() && model.frequency[Eigen::Index(k)] <= highest; ++k) {
    const auto mode         = Eigen::Index(k);
    const FirstToPart first = first_to_part(stand, k);
    const double moves      = std::abs(model.point(mover_of(model, mode), mode));
    if (!(stand.rate[k] > 0) || strain(k) < no_strain * largest_strain || !(moves > 0))
      continue;
    NonlinearMode made;
    made.number    = int(k) + 1;
    made.frequency = model.frequency[mode];
    made.mover     = model.labels[std::size_t(mover_of(model, mode))];
    made.opens     = stand.springs[first.spring].name;
    follow_backbone(made, stand, mode, moves, first, run.modal_peak[mode]);
    if (stand.damping > 0 || stand.gap_damper > 0) {
      made.parting_force          = parting_force(stand, made.frequency);
      made.force                  = force;
      const PeriodicMotion driven = forced_motion(stand, made.frequency, force, harmonics_kept);
      if (driven.settled)
        made.harmonics = harmonics_of(model, driven);
    }
    modes.push_back(std::move(made));
  }
  return modes;
}

double scale_to_part(const CurveStand &stand, const ModalModel &model, const ForceRecord &force,
                     const double output_rate, const double least)
{
  constexpr double most = 1000, close = 1e-3, parted = 1e-3;
  const double mean       = force.force.mean();
  const auto least_forces = [&](const double scale) {
    const ForceRecord scaled{force.time, mean + scale * (force.force.array() - mean), {}};
    double smallest = 1;
    for (const SpringReach &spring : fixed_step_response(stand, model, scaled, output_rate).springs)
      smallest = std::min(smallest, spring.least);
    return smallest;
  };
  // A force falls nearly in proportion; below `parted` of the force at rest it is taken as zero.
  double low = 0, at_low = 1, high = not_given, scale = 1, now = least;
  try {
    for (int round = 0; round < 12; ++round) {
      if (now > parted) {
        low    = scale;
        at_low = now;
      } else
        high = scale;
      if (high - low < close * high)
        return 0.5 * (low + high);
      const double aimed = low > 0 ? low / (1 - at_low) : 0.5 * high;
      scale              = std::isnan(high) ? aimed * (1 + close / 4)
                                            : std::clamp(aimed, low + 0.1 * (high - low), high - 0.1 * (high - low));
      if (!(scale <= most))
        return not_given;
      now = least_forces(scale);
    }
  } catch (const SolverError &) {
    return not_given;  // the scaled force pulls the rolls apart for good
  }
  return std::isnan(high) ? not_given : 0.5 * (low + high);
}
}  // namespace mill::dynamics
