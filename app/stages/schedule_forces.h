#pragma once
#include "app/run_context.h"
#include "bite/schedule/schedule.h"
#include "core/case/errors.h"
#include "core/model/bite_setup.h"
#include "core/records/provenance.h"
#include <string>
#include <vector>

// Rolling force of every pass of a schedule: given or computed, what it says of flow stress and friction, the same
// passes by the other theories and by finite elements.  theory.md 39
namespace mill {
struct ScheduleQuestion {
  std::vector<bite::ScheduledPass> passes;
  std::vector<Place> places;  ///< of the rows of the passes
  BiteSetup setup;            ///< of the models that stand beside the closed theories
  std::string roll_key;       ///< of the roll at the strip, "roll.0.barrel_diameter"
  std::string family;         ///< first part of the names of the results, "cluster"
  bool with_models = true;    ///< also the slab theories and finite elements of [bite]
};

/// Passes whose force is neither given nor can be computed, friction outside the range of its law, a pass that no
/// roll takes: said before anything is computed.
/// @throws InputError  with the place of every such pass
void check_schedule(const ScheduleQuestion &question);

/// Force that a pass works with, N: its load, or that of its flow stress law on Hitchcock's arc.
/// @throws InputError, SolverError  it has none
double working_force(const bite::ScheduledPass &pass);

/// FAMILY.PASS.force, .flow_stress, .flattened_radius and others, FAMILY.fit.*, bite.PASS.*, curves/schedule.json.
/// Fits say that they are fits; what cannot be fitted becomes a warning.
ScheduleRecord add_schedule_forces(RunContext &run, const ScheduleQuestion &question);

/// Keys behind a result of add_schedule_forces but those of bite.PASS.*; nothing: it is none of them.
/// @param name  "cluster.pass 1.flow_stress"
std::optional<KeyList> schedule_inputs(const ScheduleQuestion &question, const std::string &name);
}  // namespace mill
