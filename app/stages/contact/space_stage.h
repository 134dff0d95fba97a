#pragma once
#include "app/run/run_context.h"
#include "core/model/two_cylinders.h"

namespace mill {
/// Two bodies of revolution in space by boundary elements on half spaces: contact.space.*, curves and figures.
/// theory.md 33.3, 33.4
/// @throws SolverError  no grid wide enough for the contact
void solve_space(RunContext &run, const TwoCylinders &pair);
}  // namespace mill
