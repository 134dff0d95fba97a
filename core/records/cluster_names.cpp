#include "core/records/cluster_names.h"
#include <map>

namespace mill {
const char *unit_of_cluster_key(const std::string &key)
{
  static const std::map<std::string, const char *> units{
      {"stiffness", "N/m"}, {"guard", "N/m"},         {"strip_stiffness", "N/m"}, {"load", "N"},
      {"preload", "N"},     {"direction", "rad"},     {"half_angle", "rad"},      {"mass", "kg"},
      {"density", "kg/m3"}, {"youngs_modulus", "Pa"}, {"barrel_diameter", "m"},   {"barrel_length", "m"},
      {"length", "m"}};
  const auto unit = units.find(key.substr(key.rfind('.') + 1));
  return unit == units.end() ? "1" : unit->second;
}
}  // namespace mill
