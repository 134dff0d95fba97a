#pragma once
#include "app/stages/response/campbell_stage.h"
#include "core/case/kinds.h"
#include <string>
#include <vector>

namespace mill {
/// What turns in a stand that is drawn, with the bearings that have rollers.
std::vector<TurningRoll> turning_rolls(const FourHigh &stand);
/// The diameters that [campbell] gives where no roll is drawn.
std::vector<TurningRoll> turning_rolls(const Lumped &lumped);

/// The line of a Campbell diagram by its name, the ranges that it is drawn over and how many orders are, as text:
/// of a stand of kind four-high or lumped.
/// @param line  of the drive by the number of its order, "drive, 0": another name of an order is the same line
std::string text_of_line(const CaseSpec &spec, const std::string &line);
}  // namespace mill
