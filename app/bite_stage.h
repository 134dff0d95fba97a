#pragma once
#include "app/run_context.h"
#include "core/stand.h"

namespace mill {
/// K4 of one pass from the slab model; returns the combined stiffness (plastic slope in series with both arcs).
/// @param write  true: add K4.* to the results and write curves/bite.csv
/// @param force  N, recorded, stands beside the computed one
Parameter solve_bite_stiffness(RunContext &run, const FourHigh &stand, const Pass &pass, double force, bool write);
}  // namespace mill
