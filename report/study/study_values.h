#pragma once
#include "report/plot/svg_plot.h"
#include <nlohmann/json.hpp>
#include <string>

// What the sections of a study's page share.
namespace mill::report {
constexpr double pair_width = 450;  // px, of two drawings side by side

/// From SI to the unit of the mill floor, by the size of the base value of a result.
struct FloorUnit {
  double factor;
  std::string sign;
};
FloorUnit floor_unit(const nlohmann::json &result);

/// Axis of an input in its own unit, of a result in that of the mill floor.
Axis axis_of_key(const nlohmann::json &key);
Axis axis_of_result(const nlohmann::json &result);
}  // namespace mill::report
