#pragma once
#include "core/model/process_advice.h"
#include "dynamics/chatter/sensitivity.h"
#include <string>
#include <vector>

// What may be done to a pass.  theory.md 46.5
namespace mill::twin {
/// One thing to do to the rolling process: a factor on the speed or on a number of the pass.
struct ProcessAction {
  std::string name;       ///< "entry thickness x 0.95"
  std::string parameter;  ///< "entry thickness"; two actions on one of them are no pair
  std::string means;      ///< what could bring the change about
  std::string slope_key;  ///< of the exact slopes of a critical speed; empty: the speed
  double factor = 1;      ///< -
  int number    = -1;     ///< bite::PassNumber; -1: the speed
};

/// Single actions at their bounds; none on what the pass has not (a tension, an oil).
/// @param bounds  factors; 1 is not tried
std::vector<ProcessAction> process_actions(const bite::RollBite &bite, const ProcessAdvice &bounds);

/// A pass after some actions.
struct ChangedPass {
  bite::RollBite bite;      ///< its roll_speed is not changed
  double speed_factor = 1;  ///< -, on the working speed
};
ChangedPass changed_pass(const bite::RollBite &bite, const std::vector<ProcessAction> &actions);

/// Limits that a pass violates, for any motion of the stand.
struct Violations {
  std::vector<std::string> against;  ///< one sentence each
  bool kept_apart = false;           ///< among them what no partner can mend
};

struct CriticalState;
/// Missing bite, thicker strip than before all rolling, least speed, force and torque.
/// @param now    before the actions
/// @param after  after them
/// @param working_speed  m/s, before them
Violations violations(const ChangedPass &pass, const CriticalState &now, const CriticalState &after,
                      double working_speed, const ProcessAdvice &limits);
}  // namespace mill::twin
