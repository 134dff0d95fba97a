#pragma once
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/chatter/speed.h"
#include "twin/advice/advice.h"
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

// What would raise the critical speed of a stand.  theory.md 46.5
namespace mill::twin {
/// Numbers of the structure by their keys (dynamics::StructureNumber), each times a factor.
using StructureChanges = std::vector<std::pair<std::string, double>>;

struct CriticalQuestion {
  dynamics::ChatterStandModel stand;
  bite::RollBite bite;
  bite::Linearisation scheme = bite::Linearisation::sequential;
  dynamics::SpeedRange range;
  std::vector<dynamics::StructureNumber> numbers;  ///< of the structure: springs and dampers that may be changed
  /// The structure with several of its numbers changed at once.
  std::function<dynamics::StandStructure(const StructureChanges &)> changed;
  double working_speed = 0;     ///< m/s
  double wanted_speed  = 0;     ///< m/s, least that the mill is to roll at
  double margin        = 0.1;   ///< -, critical speed >= (1 + margin) working speed
  double force_rise    = 0.05;  ///< -, most that the rolling force may rise at the working speed
  double torque_rise   = std::numeric_limits<double>::quiet_NaN();  ///< -, likewise of the torque; NaN: any
  /// Factors that are tried, 1 is not.
  std::array<double, 2> speed = {1, 1}, entry_thickness = {1, 1}, entry_tension = {1, 1}, exit_tension = {1, 1},
                        viscosity = {1, 1}, stiffness = {1, 1}, damping = {1, 1};
  int paired  = 3;  ///< so many of the best single actions are tried in pairs
  int threads = 1;
};

/// A stand at its working speed, and the speed above which it is unstable.
struct CriticalState {
  dynamics::CriticalSpeed found;
  double speed  = 0;      ///< m/s, critical one; without one the end of the range that is stable or unstable
  bool at_least = false;  ///< nothing grows up to `speed`
  bool no_bite  = false;  ///< there is no steady bite at the working speed
  std::string why;        ///< why not
  double force    = std::numeric_limits<double>::quiet_NaN();  ///< N, at the working speed
  double torque   = std::numeric_limits<double>::quiet_NaN();  ///< N m, one roll
  double friction = std::numeric_limits<double>::quiet_NaN();  ///< -
  double growth   = std::numeric_limits<double>::quiet_NaN();  ///< 1/s, of the least stable mode
  double output   = std::numeric_limits<double>::quiet_NaN();  ///< m3/s, strip that leaves
};
CriticalState critical_state(const dynamics::ChatterStandModel &stand, const bite::RollBite &bite,
                             bite::Linearisation scheme, const dynamics::SpeedRange &range, double working_speed);

struct CriticalAdvice {
  CriticalState now;
  bool reached = false;               ///< the wanted margin is there already
  dynamics::SensitivityTable slopes;  ///< exact ones; empty inputs where there is no critical speed
  std::vector<RatedAction> actions;   ///< ranked; change: of critical over working speed
  std::vector<bool> reaches;          ///< by actions: the wanted margin is reached
  std::vector<CriticalState> states;  ///< by actions
};

/// Single actions at their bounds, then pairs of the best three that a partner could make acceptable, each with
/// the steady bite and the critical speed of the changed mill; the exit thickness stays.
/// @throws InputError, SolverError  no steady bite at the working speed of the mill as it is
/// Cost: one search (some 10 ms with six masses) for each action.
CriticalAdvice critical_advice(const CriticalQuestion &question);
}  // namespace mill::twin
