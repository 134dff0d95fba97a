#include "dynamics/nonlinear/curve_study.h"
#include "dynamics/nonlinear/mode_study.h"
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
constexpr double matters = 0.01;  // of a level, from which linear springs are not enough

NonlinearRoll roll_record(const CurveRuns &runs, const int roll)
{
  const auto level_of = [&](const Response &r) { return level(r.acceleration.col(roll)); };
  const Level curve = level_of(runs.curve.response), linear = level_of(runs.linear),
              fixed = level_of(runs.fixed.response);
  return {runs.linear.labels[std::size_t(roll)],
          curve.peak,
          curve.rms,
          linear.peak,
          linear.rms,
          fixed.peak,
          fixed.rms};
}

// Relative difference of the level that is furthest from the one on linear springs; NaN where one has no ratio.
double furthest_level(const std::vector<NonlinearRoll> &rolls)
{
  double furthest = 0;
  for (const NonlinearRoll &roll : rolls)
    for (const double ratio : {roll.rms / roll.linear_rms, roll.peak / roll.linear_peak}) {
      if (std::isnan(ratio))
        return ratio;
      if (std::abs(ratio - 1) > std::abs(furthest))
        furthest = ratio - 1;
    }
  return furthest;
}
}  // namespace

CurveRuns curve_runs(const DrivenCurves &drive, const DrivenModel &linear, const ForceRecord &force,
                     const double output_rate)
{
  return {curve_response(drive.stand, drive.modal, force, output_rate),
          fixed_step_response(drive.stand, drive.modal, force, output_rate),
          mill_response(linear, force, output_rate)};
}

NonlinearRecord curve_study(const DrivenCurves &drive, const CurveRuns &runs, const ForceRecord &force,
                            const double output_rate)
{
  NonlinearRecord record;
  record.force_range = force.force.maxCoeff() - force.force.minCoeff();
  record.balance     = runs.curve.balance;
  record.duration    = force.time[force.time.size() - 1] - force.time[0];
  record.springs     = drive.springs;
  double least       = 1;
  for (std::size_t i = 0; i < record.springs.size(); ++i) {
    const SpringReach &reach   = runs.curve.springs[i];
    record.springs[i].least    = reach.least;
    record.springs[i].least_at = reach.least_at;
    record.springs[i].largest  = reach.largest;
    record.springs[i].parted   = int(reach.parted);
    least                      = std::min(least, reach.least);
  }
  record.rolls         = {roll_record(runs, upper_work_roll), roll_record(runs, lower_work_roll)};
  record.modes         = mode_study(drive.stand, drive.modal, runs.curve, record.force_range / 2, drive.highest);
  record.scale_to_part = scale_to_part(drive.stand, drive.modal, force, output_rate, least);
  return record;
}

LinearVerdict linear_verdict(const NonlinearRecord &record)
{
  LinearVerdict out;
  out.furthest = furthest_level(record.rolls);
  for (const NonlinearSpring &spring : record.springs) {
    out.parts = out.parts || spring.parted > 0;
    if (spring.least < (out.softest ? out.softest->least : 1))
      out.softest = &spring;
  }
  out.enough = !out.parts && std::abs(out.furthest) <= matters;
  return out;
}

bool leaves_samples(const NonlinearSpring &spring)
{
  return spring.largest * spring.rest > spring.high ||
         (spring.parted == 0 && spring.least * spring.rest < spring.low);
}

const NonlinearMode *first_to_part(const NonlinearRecord &record)
{
  const NonlinearMode *first = nullptr;
  for (const NonlinearMode &mode : record.modes)
    if (!std::isnan(mode.parting_force) && (!first || mode.parting_force < first->parting_force))
      first = &mode;
  return first;
}
}  // namespace mill::dynamics
