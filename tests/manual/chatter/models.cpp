#include "tests/manual/chatter/models.h"
#include <stdexcept>

namespace mill::verify {
namespace {
constexpr std::array<double, 6> springs{6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10};

std::array<double, 6> dampers(const double scale, const double screw_down_and_lower)
{
  return {scale * screw_down_and_lower, scale * 4.25, scale * 6.05, scale * 6.05, scale * 4.25,
          scale * screw_down_and_lower};
}
}  // namespace

SixMasses six_masses(const std::string &name)
{
  const auto masses = [](const double upper_backup, const double lower_backup, const double lower_housing) {
    return std::array<double, 6>{119e3, upper_backup, 9.2e3, 9.2e3, lower_backup, lower_housing};
  };
  if (name == "D")
    return {masses(75e3, 75e3, 36.5e3), springs, dampers(1e5, 6.05), 4.95};
  if (name == "D36")
    return {masses(36.5e3, 75e3, 36.5e3), springs, dampers(1e5, 6.05), 4.57};
  if (name == "C")
    return {masses(75e3, 75e3, 36.5e3), springs, dampers(1e5, 1), 6.05};
  if (name == "A")
    return {masses(36.5e3, 36.5e3, 75e3), springs, dampers(1e5, 1), 4.81};
  if (name == "B")
    return {masses(75e3, 75e3, 36.5e3), springs, dampers(1e8, 50), 5.21};
  throw std::logic_error("no stand " + name);
}

SixMasses stand_on_damping_scale(const double scale)
{
  SixMasses stand = six_masses("D");
  stand.damping   = dampers(scale, 6.05);
  return stand;
}

dynamics::ChatterStandModel chatter_stand(const SixMasses &stand)
{
  return {dynamics::six_mass_structure(stand.mass, stand.stiffness, stand.damping), stand.distance, stand.distance,
          210e9};
}

dynamics::ChatterStandModel chatter_stand(const std::string &name)
{
  return chatter_stand(six_masses(name));
}

const char *const chatter_source =
    "X. Liu, Y. Zang, Z. Gao, L. Zeng, J. Vibroengineering 19 (2017); values by an independent program, entries ";
const char *const chatter_stands =
    "Six masses of an asymmetric four-high coupled to the bite by force, gap and the tensions of the strip. ";
}  // namespace mill::verify
