#pragma once
#include "core/base/operating_point.h"
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sample {
/// One entry of results.json.
/// @param checks  name and note of each, with their values after them
// clang-format off: lists of lists of different lengths crash clang-format 14 with AlignArrayOfStructures
inline nlohmann::ordered_json value(const double number, const std::string &unit, const std::string &source,
                                    const mill::OperatingPoint &at = {}, const double error = NAN,
                                    const std::vector<std::string> &inputs                = {},
                                    const std::vector<std::array<std::string, 2>> &checks = {},
                                    const std::vector<double> &check_values               = {})
{
  nlohmann::ordered_json json{{"value", number}, {"unit", unit}, {"source", source}};
  if (!at.empty())
    json["at"] = at.text();
  for (const auto &quantity : at.values())
    json["at_values"].push_back({{"value", quantity.value}, {"unit", quantity.unit}});
  json["error_estimate"] = error;
  json["inputs"]         = inputs;
  for (std::size_t i = 0; i < checks.size(); ++i)
    json["checks"].push_back({{"name", checks[i][0]}, {"value", check_values[i]}, {"note", checks[i][1]}});
  return json;
}
// clang-format on
}  // namespace sample
