#pragma once
#include "reduce/bite/fit/fit.h"

// Which of the wanted numbers the measured values can tell at all.  theory.md 31.3
namespace mill::bite {
/// A number that keeps the value of the case, and why.
struct KeptUnknown {
  FitUnknown unknown;
  std::vector<FitUnknown> among;  ///< the unknowns that its direction is one of
  FitDirection direction;         ///< that the data do not know
};

struct FitAnswer {
  FitProblem problem;  ///< with the unknowns that are identified
  FitPoint best;
  std::vector<KeptUnknown> kept;
  std::vector<FitInterval> intervals;  ///< of the unknowns, by find_intervals()
};

/// Along a direction known worse than this (a factor of 1.6 either way with 95 %) numbers are not identified.
constexpr double identified_within = 0.25;

/// Least misfit over the unknowns that the data identify; the number with the largest share in a direction that
/// they do not determine keeps its value, unless they refuse that value.
/// @param one_number  measured values of one kind: one unknown is left, even if the passes seem to identify more
/// @throws InputError   a pass that no friction and no flow stress makes possible
/// @throws SolverError  as least_misfit
FitAnswer identify(FitProblem problem, bool one_number);

/// Fills in the intervals.
void find_intervals(FitAnswer &answer);
}  // namespace mill::bite
