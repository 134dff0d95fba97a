#pragma once
#include "fem/contact/mode_equations.h"
#include "fem/contact/problem.h"
#include <vector>

namespace mill::contact {
/// Active set without exchange, for the contacts where exchange does not end.  Forces on a few nodes that balance
/// the loading, together with a gap made to suit them, are a solution; the gap is then carried over into the true
/// one and the set followed from event to event (continuation.h).  Ends for every symmetric positive definite C.
///
/// @param modes  those of the problem
/// @return nodes that touch
/// @throws SolverError  no equilibrium of pressing forces, or one that leaves a motion undetermined
/// Cost: about one event per node that touches in the end, each O(n^2).
std::vector<int> set_by_continuation(const Problem &problem, const ScaledModes &modes,
                                     const Loading &scaled_loading);
}  // namespace mill::contact
