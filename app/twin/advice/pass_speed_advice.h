#pragma once
#include "app/twin/advice/advised_model.h"
#include "twin/advice/advice_files.h"

namespace mill {
struct Case;

/// Is the critical speed of the first pass of a four-high the goal?  advice.goal decides; without it the pass has
/// a speed and a bite, and neither a place, a band nor a measured force is asked.
/// @param measured  folder of --measured; empty: none
/// @throws InputError  advice.goal = "critical-speed" without a speed or a bite (names the keys), or with a
///         measured force
bool asks_critical_speed(const Case &the_case, const RolledAdvice &rolled, const std::string &measured);

/// Advice on the critical speed of the first pass of a four-high, in the detailed model of advice.model: pass,
/// springs, dampers on the chocks; damping ratios as what-ifs.  At the wanted speed where that is above the
/// present one.  theory.md 46.5
/// @throws InputError, SolverError  no steady bite at that speed, none in the range searched
/// Cost: with beams 0.1 s to 0.4 s for each of some 40 actions.
twin::AdviceRecord pass_speed_advice(const Case &the_case, const RolledAdvice &rolled,
                                     const Components &components, int threads);
}  // namespace mill
