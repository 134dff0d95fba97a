#pragma once
#include "fem/strip/rigid_plastic/strip_flow_equations.h"

namespace mill::fem {
/// What is read off a solved state; derivatives, history, time and lines are left to the caller.
StripFlow strip_flow_results(const StripPass &pass, const StripGrid &grid, const StripStage &stage,
                             const Eigen::VectorXd &unknowns);
}  // namespace mill::fem
