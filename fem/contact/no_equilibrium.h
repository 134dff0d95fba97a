#pragma once
#include "fem/contact/mode_equations.h"
#include "fem/contact/problem.h"
#include "fem/contact/reachable.h"
#include <vector>

// Why a contact has no equilibrium, with the remedy.
namespace mill::contact {
/// @param imposed  modes whose resultant is given
/// @throws SolverError
[[noreturn]] void refuse_undetermined(const std::vector<int> &imposed);

/// @param support  the pressing forces that come closest
/// @throws SolverError
[[noreturn]] void refuse_unreachable(const Support &support, const ScaledModes &modes,
                                     const std::vector<int> &imposed, const Loading &loading);
}  // namespace mill::contact
