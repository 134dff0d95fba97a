#pragma once
#include "core/numerics/difference.h"
#include "core/records/nonlinear_record.h"
#include "dynamics/nonlinear/curve_response.h"
#include <cmath>
#include <vector>

// A pass driven on the curves of its contacts, compared with linear springs and with fixed steps: no text, no
// files. theory.md 36
namespace mill::dynamics {
/// What is driven on curves.
struct DrivenCurves {
  CurveStand stand;
  ModalModel modal;                      ///< the same modes, for what is seen of them
  std::vector<NonlinearSpring> springs;  ///< in the order of stand.laws, without what a run adds
  double highest = 0;                    ///< Hz, modes to be looked at
};

/// A pass driven on curves, on the curves by fixed steps, and on their slopes.
struct CurveRuns {
  CurveRun curve, fixed;
  Response linear;
};
/// @param linear  driven with the slopes of the curves at rest
/// Errors and cost as curve_response() and fixed_step_response().
CurveRuns curve_runs(const DrivenCurves &drive, const DrivenModel &linear, const ForceRecord &force,
                     double output_rate);

/// Numbers of the record of a pass; names of pass, model and modes, sentences and notes are left empty.
/// Cost: mode_study() and scale_to_part().
NonlinearRecord curve_study(const DrivenCurves &drive, const CurveRuns &runs, const ForceRecord &force,
                            double output_rate);

/// How far the work rolls on curves are from those on linear springs.
struct LinearVerdict {
  double furthest = 0;                       ///< -, relative difference of a peak or rms, the largest; NaN: one of
                                             ///< them has no ratio, 0/0 or a run without an end
  const NonlinearSpring *softest = nullptr;  ///< whose force falls most; null: no force falls
  bool parts                     = false;    ///< a spring parts
  bool enough                    = false;    ///< linear springs: nothing parts, and within 1 %
};
/// @param record  outlives the answer, which points into it
LinearVerdict linear_verdict(const NonlinearRecord &record);

/// Relative error of a level on curves: the distance of its fixed steps.
inline double level_error(const NonlinearRoll &roll)
{
  return difference(roll.fixed_rms, roll.rms);
}

/// Whether a spring went beyond the samples of its curve.
bool leaves_samples(const NonlinearSpring &spring);

/// Whether amplitude moves a mode, from 0.1 % of its frequency on.
inline bool bends(const NonlinearMode &mode)
{
  return std::abs(mode.bend) > 0.001;
}

/// The mode in which the least harmonic force parts a spring; null: none does.
const NonlinearMode *first_to_part(const NonlinearRecord &record);
}  // namespace mill::dynamics
