#include "tests/manual/stand/housing_models.h"
#include "tests/manual/contact/meshed.h"

namespace mill::verify {
// Housing of a 1400 mm four-high stand, backup rolls 1450 mm; every dimension is assumed.
MillHousing demo_housing()
{
  MillHousing h;
  h.thickness         = 0.70;
  h.post_width        = 0.65;
  h.window_width      = 1.62;
  h.window_height     = 5.60;
  h.upper_beam_height = 1.20;
  h.lower_beam_height = 1.20;
  h.fillet_radius     = 0.25;
  h.foot_height       = 0.90;
  h.screw_pad         = 0.60;
  h.seat_pad          = 0.70;
  return h;
}

// The same below and above its feet.
MillHousing mirrored(MillHousing h)
{
  h.foot_height       = 0.5 * h.window_height;
  h.seat_pad          = h.screw_pad;
  h.lower_beam_height = h.upper_beam_height;
  return h;
}

fem::ElasticBody meshed(const MillHousing &h, const HousingMeshSize &size)
{
  const ScratchFile file("housing");
  return {meshes::mesh_housing(h, size, file.path), h.steel, 2};
}

fem::HousingStatics solved(const MillHousing &h, const HousingMeshSize &size)
{
  return fem::housing_statics(h, meshed(h, size));
}

double upper_mass(const fem::HousingStatics &s)
{
  return s.reduced_mass[fem::upper_post] + s.reduced_mass[fem::upper_beam];
}
double lower_mass(const fem::HousingStatics &s)
{
  return s.reduced_mass[fem::lower_post] + s.reduced_mass[fem::lower_beam];
}
}  // namespace mill::verify
