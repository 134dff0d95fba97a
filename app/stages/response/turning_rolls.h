#pragma once
#include "app/stages/response/campbell_stage.h"
#include <vector>

namespace mill {
struct FourHigh;
struct Lumped;

/// What turns in a stand that is drawn, with the bearings that have rollers.
std::vector<TurningRoll> turning_rolls(const FourHigh &stand);
/// The diameters that [campbell] gives where no roll is drawn.
std::vector<TurningRoll> turning_rolls(const Lumped &lumped);
}  // namespace mill
