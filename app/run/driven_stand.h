#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/model/pass.h"
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

/// How far a run goes; each goal needs the ones above it, except chatter and simulate, which do not need each
/// other.
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
}  // namespace mill
