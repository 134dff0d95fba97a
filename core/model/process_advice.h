#pragma once
#include "core/base/choice.h"
#include "core/model/advice.h"
#include "core/model/dynamics_settings.h"
#include <array>
#include <optional>

// What millstand advise may do to a pass and what that must keep: [advice].
namespace mill {
/// Bounds are factors on the present value.
struct ProcessAdvice {
  double wanted_speed                   = not_given;  ///< m/s, at least as fast it shall roll; NaN: as now
  double force_rise                     = 0.05;       ///< -, most that the rolling force may rise
  double torque_rise                    = not_given;  ///< -, most that the rolling torque may rise; NaN: any
  std::array<double, 2> speed           = {0.9, 1};
  std::array<double, 2> entry_thickness = {0.95, 1.05};
  std::array<double, 2> entry_tension   = {0.8, 1.2};
  std::array<double, 2> exit_tension    = {0.8, 1.2};
  std::array<double, 2> viscosity       = {0.8, 1.2};  ///< of the oil, where friction follows its film
  std::array<double, 2> friction        = {0.8, 1.2};  ///< where it does not
  std::array<double, 2> flow_stress     = {1, 1};
};

enum class AdviceGoal { critical_speed, level };
constexpr auto words_of(AdviceGoal)
{
  return choice_words<AdviceGoal>("critical-speed", "level");
}

/// What a level or a critical speed asks of the pass that is rolled.  No run of a stand uses it, so that it is not
/// part of a Case.
struct RolledAdvice : ProcessAdvice {
  RolledAdvice()
  {
    flow_stress = {0.95, 1.05};
  }
  std::optional<AdviceGoal> goal;                ///< absent: by what the case says
  StandModelKind model  = StandModelKind::beam;  ///< in which every action is repeated and which decides
  double margin         = 0.10;                  ///< -, critical speed >= (1 + margin) working speed
  double nearer_chatter = 0.01;                  ///< -, most that critical over working speed may fall
};

/// [advice] of kind four-high as it is read.
struct FourHighAdvice : StandAdvice, RolledAdvice {};
}  // namespace mill
