#pragma once
#include "app/run_context.h"
#include "core/model/dynamics_settings.h"
#include "core/model/pass.h"
#include "core/records/lumped_model.h"
#include "core/records/records.h"
#include "dynamics/response/modal_model.h"
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mill::reduce {
struct StandWithModes;
}
namespace mill {
struct CurveDrive;
struct FourHigh;
struct Lumped;

/// How far a run goes; each goal needs the ones above it, but chatter and simulate, which stand beside each other.
enum class Goal { stiffness, masses, modes, chatter, simulate };

/// What a pass of a case drives, without driving it: for export.
struct DrivenStand {
  LumpedModel chain;
  DynamicsSettings dynamics;
  std::optional<dynamics::ModalModel> modes;  ///< of a detailed stand; nothing: the chain of six masses is driven
  std::shared_ptr<const reduce::StandWithModes>
      detailed;  ///< it, with the errors of its connections; null: the chain
  Pass pass;
  ForceRecord force;                                   ///< empty: the pass has none
  double load = 0;                                     ///< N, working load of the pass
  std::vector<std::string> warnings;                   ///< of the stages
  std::shared_ptr<const CurveDrive> curves = nullptr;  ///< of its contacts, dynamics.contact = "curve"
};

/// Those of kind "four-high" and of kind "lumped", from the stages that are needed for it.
/// @param pass  its name; empty: the first
/// @throws InputError  no pass of this name
DrivenStand driven_four_high(RunContext &run, FourHigh stand, const std::string &pass);
DrivenStand driven_lumped(RunContext &run, const Lumped &lumped, const std::string &pass);

/// The stages of a case in order, up to the goal.  Results, curves and the lumped model are in the run's
/// folder afterwards.
/// @param force_file  replaces the force record of every pass (simulate --force); empty: none
void run_stages(RunContext &run, Goal goal, const std::string &force_file = "");

/// Those of kind "four-high" and of kind "lumped".
void run_four_high(RunContext &run, FourHigh stand, Goal goal, const std::string &force_file);
void run_lumped(RunContext &run, Lumped lumped, Goal goal, const std::string &force_file);
}  // namespace mill
