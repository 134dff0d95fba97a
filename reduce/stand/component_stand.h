#pragma once
#include "reduce/stand/stand_assembly.h"
#include <optional>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// Reduced bodies of a stand.  Upper and lower rolls are the same.
struct StandComponents {
  Component work_roll, backup_roll;
  std::optional<Component> housing;  ///< both housings; absent: frame of two lumps
};

/// The stand put together from component modes: model "craig-bampton".  theory.md 22.3
/// Contact lines are beds of K3 / length and K5 / length over the common barrel length, integrated exactly for the
/// Legendre functions; bearing seats are joined by springs.
/// @throws InputError  as component_roll and assemble_stand
StandModel component_stand(const FourHigh &stand, const StandSprings &springs, const StandComponents &components);
}  // namespace mill::reduce
