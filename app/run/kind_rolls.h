#pragma once
#include "dynamics/marks/marks.h"
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

// What kinds of case with a list of rolls, roll.0 .., have in common.
namespace mill {
/// A roll as a source of marks.
/// @param i         its place in the case
/// @param diameter  m
dynamics::MarkRoll mark_roll(const std::string &name, std::size_t i, double diameter);

/// Adds "roll_NAME_diameter", m, to the geometry of run.json.
void describe_roll(nlohmann::ordered_json &manifest, const std::string &name, double diameter);
}  // namespace mill
