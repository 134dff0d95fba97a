#pragma once
#include "core/base/warning.h"
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
/// other.  Of a four-high stand the roll contacts alone are a goal as well.
enum class Goal { contacts, stiffness, masses, modes, chatter, simulate };

/// What the reduction of a stand to some of its modes costs.
struct StaticRest {
  Eigen::Index kept = 0, all = 0;  ///< modes
  double limit   = 0;              ///< Hz, up to which the modes are right
  double fastest = 0;              ///< Hz, of those that are kept
  double missing = 0;              ///< -, of the static compliance of the gap, without the rest
  double error   = 0;              ///< -, response of the gap up to the limit, over its largest value
};

/// What a pass of a case drives, without driving it: for export.
struct DrivenStand {
  LumpedModel chain;
  DynamicsSettings dynamics;
  std::optional<dynamics::ModalModel> modes;  ///< of a detailed stand; nothing: the chain of six masses is driven
  std::shared_ptr<const reduce::StandWithModes>
      detailed;                    ///< it, with the errors of its connections; null: the chain
  std::optional<StaticRest> rest;  ///< one more mode of `modes`, for export (app/export/static_rest.h)
  Pass pass;
  ForceRecord force;                                   ///< empty: the pass has none
  double load = 0;                                     ///< N, working load of the pass
  std::vector<Warning> warnings;                       ///< of the stages
  std::shared_ptr<const CurveDrive> curves = nullptr;  ///< of its contacts, dynamics.contact = "curve"
};
}  // namespace mill
