#include "app/stages/bite/free_strip.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double usual_distance = 5;  // m
}  // namespace

std::vector<std::string> keys_missing_of_bite(const Case &the_case)
{
  std::vector<std::string> missing;
  for (const char *key :
       {"strip.entry_thickness", "strip.exit_thickness", "strip.friction", "strip.flow_stress"}) {
    const bool is_there = std::any_of(the_case.places.begin(), the_case.places.end(), [&](const auto &entry) {
      return entry.first == key || entry.first.rfind(std::string(key) + ".", 0) == 0;
    });
    if (!is_there)
      missing.emplace_back(key);
  }
  return missing;
}

std::string missing_of_bite(const Case &the_case)
{
  std::string missing;
  for (const std::string &key : keys_missing_of_bite(the_case))
    missing += (missing.empty() ? "" : ", ") + key;
  return missing;
}

FreeStrip free_strip(const FourHigh &stand)
{
  FreeStrip strip;
  const auto distance = [&](const double given, const char *key) {
    if (!std::isnan(given))
      return given;
    strip.assumed.push_back(
        fmt::format("stand.{} is not given: {:g} m of free strip are assumed", key, usual_distance));
    return usual_distance;
  };
  strip.entry_distance = distance(stand.span.entry_distance, "entry_distance");
  strip.exit_distance  = distance(stand.span.exit_distance, "exit_distance");
  return strip;
}
}  // namespace mill
