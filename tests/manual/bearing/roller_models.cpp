#include "tests/manual/bearing/roller_models.h"
#include "meshes/bearing/roller.h"
#include "tests/manual/check/units.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace mill::verify {
RollerSetup demo_roller()
{
  RollerSetup s;
  s.diameter     = 21.5 * mm;
  s.length       = 33.4 * mm;
  s.inner_radius = 144.8 * mm;
  s.outer_radius = 166.3 * mm;
  s.inner_depth = s.outer_depth = 12 * mm;
  s.material                    = {206e9, 0.3, 7850};
  s.largest_load                = 60 * kN;
  s.finest_load                 = 4 * kN;
  return s;
}

RollerSetup fine_demo_roller()
{
  RollerSetup s             = demo_roller();
  s.elements_per_half_width = 1.6;
  s.largest_element         = 2.8 * mm;
  s.end_element             = 0.3 * mm;
  return s;
}

double demo_roller_drop(const double x)
{
  const RollerSetup s = demo_roller();
  return 0.00045 * s.diameter * -std::log(1 - std::pow(2 * x / s.length, 2));
}

fem::CondensedRoller condensed(const RollerSetup &setup)
{
  const auto meshes = meshes::mesh_roller(setup, std::filesystem::temp_directory_path().string(),
                                          fmt::format("millstand-verify-{}", ::getpid()));
  auto roller       = fem::condense_roller(setup, meshes);
  meshes::remove_meshes(meshes);
  return roller;
}
}  // namespace mill::verify
