#pragma once
#include "core/model/process_advice.h"
#include "twin/advice/advice.h"
#include "twin/advice/critical_state.h"
#include "twin/chatter/critical_track.h"
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

// What would raise the critical speed of a stand.  theory.md 46.5
namespace mill::twin {
/// What of a structure is changed.
enum class ChangeOf {
  spring,
  damper,
  damping_ratio,
  new_damper,    ///< one that a StructureAction adds
  rolling_force  ///< springs follow it
};

/// A number of the structure by its key (dynamics::StructureNumber, StructureAction), times a factor.
struct StructureChange {
  std::string key;  ///< empty for the rolling force
  double factor;    ///< -
  ChangeOf what = ChangeOf::spring;
};
using StructureChanges = std::vector<StructureChange>;

/// A structure with its numbers.
struct NumberedStructure {
  dynamics::StandStructure structure;
  std::vector<dynamics::StructureNumber> numbers;
};

/// An action on the stand that is none of its numbers: a spring of a drawing, a damper.
struct StructureAction {
  std::string name, parameter, means;  ///< as in ProcessAction
  std::string key;                     ///< for CriticalQuestion::changed
  double factor = 1;                   ///< -
  ChangeOf what = ChangeOf::spring;
  bool what_if  = false;
};

/// Of a stand with its bite; its numbers are springs and dampers that may be changed.
struct CriticalQuestion : ChatterModel {
  /// The structure with several of its numbers changed at once.
  std::function<NumberedStructure(const StructureChanges &)> changed;
  std::vector<StructureAction> actions;  ///< tried in addition to the numbers
  /// Springs follow the rolling force: `changed` takes it, N over the present one.
  bool follows_force   = false;
  double working_speed = 0;    ///< m/s
  double margin        = 0.1;  ///< -, critical speed >= (1 + margin) working speed
  ProcessAdvice process;       ///< what is tried with the pass, and what it must keep
  std::array<double, 2> stiffness = {1, 1}, damping = {1, 1};  ///< -, factors; 1 is not tried
  std::vector<InputDoubt> doubts = usual_doubts();             ///< of the numbers of pass and stand
  int paired                     = 3;  ///< so many of the best single actions are tried in pairs
  int threads                    = 1;
};

struct CriticalAdvice {
  CriticalState now;
  bool reached  = false;                                     ///< the wanted margin is there already
  double spread = std::numeric_limits<double>::quiet_NaN();  ///< -, relative sd of the critical speed (46.10)
  dynamics::SensitivityTable slopes;  ///< exact ones; empty inputs where no critical speed exists
  std::vector<RatedAction> what_ifs;  ///< of damping ratios, by falling change
  std::vector<RatedAction> actions;   ///< ranked; change: of critical over working speed
  std::vector<bool> reaches;          ///< by actions: the wanted margin is reached
  std::vector<CriticalState> states;  ///< by actions
};

/// Single actions at their bounds, then pairs of the best three that a partner could make acceptable, each with
/// the steady bite and the critical speed of the changed mill; the exit thickness stays.  Those that the doubts in
/// the numbers do not let tell apart say so.
/// @throws InputError, SolverError  no steady bite at the working speed of the mill as it is
/// Cost: one search (some 10 ms with six masses) and its slopes (0.5 ms) for each action.
CriticalAdvice critical_advice(const CriticalQuestion &question);
}  // namespace mill::twin
