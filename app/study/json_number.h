#pragma once
#include <cmath>
#include <nlohmann/json.hpp>

namespace mill {
/// A number, or null where it is not finite.
inline nlohmann::ordered_json json_number(const double value)
{
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}
}  // namespace mill
