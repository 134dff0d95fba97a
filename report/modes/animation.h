#pragma once
#include "report/modes/model_data.h"
#include <map>
#include <string>

// Mode shapes of the stand as pictures that move.
namespace mill::report {
/// Whether the sizes that a drawing of the four rolls needs are stored.
bool has_roll_sizes(const std::map<std::string, double> &geometry);

/// A drawing of the stand for every model that has modes, with lists to choose model and mode from and controls
/// that page.js brings to life.  Without a script: the extremes of the first mode of the most detailed model.
/// Empty when no model has modes.
/// @param geometry  m, as in run.json; without it the rolls take assumed proportions
std::string mode_player(const ModelData &data, const std::map<std::string, double> &geometry);

/// Both extremes of every mode of the most detailed model in small, as one <svg> element.  Empty without lines.
std::string mode_sheet(const ModelData &data);
}  // namespace mill::report
