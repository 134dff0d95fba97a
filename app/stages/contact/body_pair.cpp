#include "app/stages/contact/body_pair.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "fem/contact/hertz.h"
#include "fem/contact/two_bodies.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
std::optional<reduce::CylinderPair> one_steel(const TwoCylinders &spec)
{
  const Material a = material_of(spec.upper, spec.steel), b = material_of(spec.lower, spec.steel);
  if (plane_engine(spec) != PlaneEngine::two_cylinders || a.youngs_modulus != b.youngs_modulus ||
      a.poisson_ratio != b.poisson_ratio)
    return std::nullopt;
  return reduce::CylinderPair{spec.upper.diameter, spec.lower.diameter, 1, a};
}

void check_tilt(const Case &the_case)
{
  const auto &pair = std::get<TwoCylinders>(the_case.spec);
  if (!pair.in_space || pair.space.tilt == 0)
    return;
  const contact::SpaceShape shape = contact::space_shape(pair);
  const double tilt = pair.space.tilt, load = pair.space.loads[0];
  if (!std::isfinite(shape.length) || shape.is_point(load, tilt))
    return;
  if (shape.length <= 2 * contact::hertz_line(load / shape.length, shape.radius, shape.modulus).half_width)
    return;
  const double with = shape.slices(load, tilt).length, without = shape.slices(load, 0).length;
  if (with >= 0.5 * without)
    return;
  const auto place = the_case.places.find("contact.space.tilt");
  throw InputError(
      place == the_case.places.end() ? Place{the_case.path} : place->second,
      fmt::format("contact.space.tilt = {:.4g} mrad lifts the faces off over more than half of the contact at "
                  "{:.6g} N, the least of loads ({:.3g} mm of {:.3g} mm carry); lower it, or raise loads",
                  1e3 * tilt, load, 1e3 * with, 1e3 * without));
}
}  // namespace mill
