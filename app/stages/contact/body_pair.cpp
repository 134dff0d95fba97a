#include "app/stages/contact/body_pair.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "core/model/ground_profile.h"
#include "core/numerics/root_search.h"
#include "fem/contact/hertz.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();

double radius_of(const RoundBody &body)
{
  return body.plane() ? infinite : 0.5 * body.diameter;
}

double or_infinite(const double value)
{
  return std::isnan(value) ? infinite : value;
}

// What the radius of one body lacks at z, m.
double body_drop(const RoundBody &body, const SpaceShape &shape, const double load, const double z)
{
  double drop = std::isnan(body.crown_radius) ? 0 : z * z / (2 * body.crown_radius);
  if (body.profile == EndProfile::arc) {
    const double half = 0.5 * body.length, arc = std::isnan(body.profile_length) ? half : body.profile_length;
    const double beyond = std::max(0., std::abs(z) - half + arc) / arc;
    drop += body.profile_drop * beyond * beyond;
  } else if (body.profile == EndProfile::log) {
    const double q = (std::isnan(body.profile_load) ? load : body.profile_load) / body.length;
    drop += logarithmic_drop(q, contact::hertz_line(q, shape.radius, shape.modulus).half_width, shape.modulus,
                             body.length, johns_gohar, z);
  } else if (body.profile == EndProfile::table) {
    drop += table_drop(body.profile_table, z);
  }
  return drop;
}
}  // namespace

std::array<contact::LineBody, 2> line_bodies_of(const TwoCylinders &pair)
{
  const auto one = [&](const RoundBody &body) {
    return contact::LineBody{radius_of(body), material_of(body, pair.steel), pair.contact.plane_depth};
  };
  return {one(pair.upper), one(pair.lower)};
}

contact::HalfSpaces half_spaces_of(const TwoCylinders &pair)
{
  return contact::half_spaces(material_of(pair.upper, pair.steel), material_of(pair.lower, pair.steel));
}

std::optional<reduce::CylinderPair> one_steel(const TwoCylinders &spec)
{
  const Material a = material_of(spec.upper, spec.steel), b = material_of(spec.lower, spec.steel);
  if (plane_engine(spec) != PlaneEngine::two_cylinders || a.youngs_modulus != b.youngs_modulus ||
      a.poisson_ratio != b.poisson_ratio)
    return std::nullopt;
  return reduce::CylinderPair{spec.upper.diameter, spec.lower.diameter, 1, a};
}

contact::GapShape SpaceShape::gap(const double tilt) const
{
  return [across = radius, along = drop, tilt, touch = first_touch(tilt)](const double x, const double z) {
    return x * x / (2 * across) + along(z) - tilt * z + touch;
  };
}

double SpaceShape::first_touch(const double tilt) const
{
  if (!std::isfinite(length) || (!relieved && std::abs(tilt) <= 0.5 * length * curvature))
    return curvature > 0 ? tilt * tilt / (2 * curvature) : 0;
  constexpr int n = 4000;  // stations; between them profiles are straight or flat at their least
  double least    = 0;
  for (int i = 0; i <= n; ++i) {
    const double z = length * (double(i) / n - 0.5);
    least          = std::min(least, drop(z) - tilt * z);
  }
  return least < 0 ? -least : 0;
}

bool SpaceShape::is_point(const double load, const double tilt) const
{
  if (curvature == 0 || relieved)
    return false;
  const double semi = contact::hertz_point(load, radius, 1 / curvature, modulus).semi_y;
  return semi + std::abs(tilt) / curvature <= 0.5 * length;
}

SpaceShape::Slices SpaceShape::slices(const double load, const double tilt) const
{
  constexpr int n    = 400;
  const double slice = length / n;
  const auto hertz   = contact::hertz_line(load / length, radius, modulus);
  const double stiff = contact::lundberg_line(hertz, load / length, length, modulus).secant / n;
  const auto carried = [&](const double approach, Slices &out) {
    double sum = 0;
    out        = {0, 0};
    for (int i = 0; i < n; ++i) {
      const double z = (i + 0.5) * slice - length / 2, depth = approach - drop(z) + tilt * z;
      if (depth > 0) {
        sum += depth * stiff;
        out.length += slice;
        out.moment += depth * stiff * z;
      }
    }
    return sum;
  };
  Slices out{};
  const double least = -std::abs(tilt) * length;
  double most        = least;
  for (double step = hertz.half_width; carried(most, out) < load; step *= 2)
    most += step;
  carried(root_between(least, most, [&](const double approach) { return carried(approach, out) - load; }).value(),
          out);
  return out;
}

SpaceShape space_shape(const TwoCylinders &pair)
{
  SpaceShape s;
  s.bodies    = half_spaces_of(pair);
  s.modulus   = contact::contact_modulus(s.bodies);
  s.radius    = contact::relative_radius(radius_of(pair.upper), radius_of(pair.lower));
  s.curvature = 1 / or_infinite(pair.upper.crown_radius) + 1 / or_infinite(pair.lower.crown_radius);
  s.length    = std::min(or_infinite(pair.upper.length), or_infinite(pair.lower.length));
  for (const RoundBody *body : {&pair.upper, &pair.lower}) {
    s.relieved  = s.relieved || body->profile != EndProfile::none;
    s.symmetric = s.symmetric && (body->profile_table.empty() || body->profile_table.front()[0] >= 0);
  }
  s.drop = [pair, plain = s](const double z) {
    if (std::abs(z) > 0.5 * plain.length)
      return infinite;
    return body_drop(pair.upper, plain, pair.space.at, z) + body_drop(pair.lower, plain, pair.space.at, z);
  };
  return s;
}

void check_tilt(const Case &the_case)
{
  const auto &pair = std::get<TwoCylinders>(the_case.spec);
  if (!pair.in_space || pair.space.tilt == 0)
    return;
  const SpaceShape shape = space_shape(pair);
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
