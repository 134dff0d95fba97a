#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/pass.h"
#include "core/model/roller_bearing.h"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

// Parts of run.json that several kinds of case have.
namespace mill {
void add_bearings(nlohmann::ordered_json &manifest, const std::vector<RollerBearing> &bearings);
void add_passes(nlohmann::ordered_json &manifest, const std::vector<Pass> &passes, ForceMeaning force_meaning);
}  // namespace mill
