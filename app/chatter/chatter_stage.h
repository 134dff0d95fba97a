#pragma once
#include "app/run/run_context.h"
#include "app/stages/stand/model_stage.h"
#include "core/model/pass.h"
#include "reduce/stand/lumped_stand.h"

namespace mill {
struct Case;
struct ChatterCase;
struct FourHigh;

/// Conditions that no strip can stand: a tension at or above its flow stress there.
/// @throws InputError  with the place of every such key
void check_conditions(const Case &the_case);

/// kind = "chatter": every condition, its variants, and the tandem they form.
void solve_chatter_case(RunContext &run, const ChatterCase &spec);

/// The conditions that follow each other in a tandem, if any do: critical speed with the delay of the strip
/// between the stands.
void solve_tandem(RunContext &run, const ChatterCase &spec);

/// One pass of a four-high stand as a working condition, on the detailed models and on six masses; the most
/// detailed one gives the results.
void solve_stand_chatter(RunContext &run, const FourHigh &stand, const Pass &pass,
                         const reduce::LumpedStand &chain, const StandModels &models);
}  // namespace mill
