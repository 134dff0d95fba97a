#pragma once
#include "app/run/run_context.h"
#include "app/stages/stand/model_stage.h"
#include "core/model/pass.h"
#include "reduce/stand/lumped_stand.h"
#include <string>
#include <vector>

namespace mill {
struct Case;
struct FourHigh;

/// Keys without which the critical speed of a pass is not searched: "pass.0.speed"; empty: all are there.
std::vector<std::string> missing_for_critical_speed(const Case &the_case, const FourHigh &stand, std::size_t pass);

/// The most detailed model of a stand without the strip between its rolls: the bite is what chatter adds.
reduce::StandWithModes without_strip(const FourHigh &stand, const reduce::LumpedStand &chain,
                                     const StandModels &models, const ComponentSets &components);

/// Critical speed of a pass on the most detailed model; a verdict that names the missing keys where the case does
/// not say enough.
void add_critical_speed(RunContext &run, const FourHigh &stand, std::size_t pass, const reduce::LumpedStand &chain,
                        const StandModels &models, const ComponentSets &components);
}  // namespace mill
