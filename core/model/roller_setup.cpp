#include "core/model/roller_setup.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
void require(const RollerSetup &s)
{
  if (!(s.diameter > 0 && s.length > 0 && s.inner_depth > 0 && s.outer_depth > 0 && s.largest_load > 0))
    throw InputError("roller: diameter, length, raceway depths and largest load must be positive");
  if (s.contact_length > s.length * (1 + 1e-12))
    throw InputError("roller: the contact is longer than the roller");
  if (s.inner_radius < 0 || s.outer_radius < 0 || (s.outer_radius > 0 && 2 * s.outer_radius <= s.diameter))
    throw InputError("roller: the outer raceway must be larger than the roller");
  if (!(s.elements_per_half_width > 0))
    throw InputError("roller: elements_per_half_width must be positive");
}

// Widest contact that is meshed, at 4.5 GPa in steel: what is wider no bearing bears, and the section has no room
// for.
constexpr double widest_half_width = 0.04;  // of the diameter
// A half width that bearings begin to reach at a fraction of their rating: 5 kN on the roller of 21.5 x 33.4 mm.
constexpr double fine_half_width = 0.006;  // of the diameter

double load_of_half_width(const RollerSetup &s, const double raceway_radius, const double half_width)
{
  return std::pow(half_width / line_half_width(s, raceway_radius, 1 / s.contact_length), 2);
}
}  // namespace

RollerSetup completed(RollerSetup s)
{
  require(s);
  const auto fill = [](double &value, const double fallback) {
    if (!(value > 0))
      value = fallback;
  };
  fill(s.contact_length, s.length);
  s.largest_load =
      std::min(s.largest_load, load_of_half_width(s, -s.outer_radius, widest_half_width * s.diameter));
  fill(s.land, 0.5 * s.diameter);
  fill(s.finest_load,
       std::min(s.largest_load / 30, load_of_half_width(s, s.inner_radius, fine_half_width * s.diameter)));
  fill(s.end_element, 0.006 * s.contact_length);
  fill(s.largest_element, 0.05 * s.contact_length);
  return s;
}

RollerSetup coarsened(RollerSetup s)
{
  s = completed(s);
  s.elements_per_half_width *= 0.5;
  s.end_element *= 2;
  s.largest_element *= 2;
  return s;
}

double line_half_width(const RollerSetup &s, const double raceway_radius, const double line_load)
{
  const double nu = s.material.poisson_ratio, E_plane = s.material.youngs_modulus / (2 * (1 - nu * nu)),
               curvature = 2 / s.diameter + (raceway_radius != 0 ? 1 / raceway_radius : 0);
  return std::sqrt(4 * std::max(line_load, 0.) / (curvature * M_PI * E_plane));
}
}  // namespace mill
