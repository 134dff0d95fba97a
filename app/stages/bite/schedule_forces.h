#pragma once
#include "app/run/run_context.h"
#include "core/model/bite_setup.h"
#include "core/records/key_list.h"
#include "reduce/bite/schedule/schedule.h"
#include <string>
#include <vector>

// What the rolling force of every pass of a schedule says of flow stress and friction, and the same passes by the
// other theories and by finite elements.  theory.md 39
namespace mill {
struct ScheduleQuestion {
  std::vector<bite::ScheduledPass> passes;
  std::vector<KeyList> keys;  ///< of the case, behind each pass
  BiteSetup setup;            ///< of the models that are compared with the closed theories
  std::string roll_key;       ///< of the roll at the strip, "roll.0.barrel_diameter"
  bool with_models = true;    ///< also the slab theories and finite elements of [bite]
};

/// FAMILY.PASS.flow_stress, .flattened_radius and others, FAMILY.schedule.*, bite.PASS.*, curves/schedule.json.
/// Fits say that they are fits; what cannot be fitted becomes a warning.
ScheduleRecord add_schedule_forces(RunContext &run, const ScheduleQuestion &question);
}  // namespace mill
