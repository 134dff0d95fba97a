#pragma once
#include "core/records/csv.h"
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Drawings of a calibration.
namespace mill::report {
/// Measured and computed response of each sensor, before and after; of records without force its level.
std::vector<std::string> response_drawings(const Table &response, const nlohmann::json &sensors);

/// Density of a force that was not recorded, with its interval; empty where the table has none.
std::string force_drawing(const Table &force);

/// The records determine this unknown of calibration.json; false where the entry is missing.
bool is_identified(const nlohmann::json &unknown);

/// How far each unknown moved, in deviations of its prior, with its interval.
std::string moved_drawing(const nlohmann::json &unknowns);

/// What the fit leaves over what a linear model must leave, over its limit, by third octave.
std::string residual_drawing(const nlohmann::json &bands, const nlohmann::json &sensors, const std::string &title);

/// Level of a force that was not recorded in narrow bands over its surroundings, with the limits.
std::string level_drawing(const nlohmann::json &bands, const std::string &title);

/// Deviance along each scanned spring.
std::vector<std::string> profile_drawings(const Table &profiles);
}  // namespace mill::report
