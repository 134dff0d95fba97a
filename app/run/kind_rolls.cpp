#include "app/run/kind_rolls.h"
#include <nlohmann/json.hpp>

namespace mill {
dynamics::MarkRoll mark_roll(const std::string &name, const std::size_t i, const double diameter)
{
  return {"roll " + name, diameter, "roll." + std::to_string(i) + ".barrel_diameter"};
}

void describe_roll(nlohmann::ordered_json &manifest, const std::string &name, const double diameter)
{
  manifest["geometry"]["roll_" + name + "_diameter"] = diameter;
}

}  // namespace mill
