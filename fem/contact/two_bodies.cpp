#include "fem/contact/two_bodies.h"
#include "core/model/ground_profile.h"
#include "core/numerics/root_search.h"
#include "fem/contact/hertz.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::contact {
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
    drop += logarithmic_drop(q, hertz_line(q, shape.radius, shape.modulus).half_width, shape.modulus, body.length,
                             johns_gohar, z);
  } else if (body.profile == EndProfile::table) {
    drop += table_drop(body.profile_table, z);
  }
  return drop;
}
}  // namespace

std::array<LineBody, 2> line_bodies_of(const TwoCylinders &pair)
{
  const auto one = [&](const RoundBody &body) {
    return LineBody{radius_of(body), material_of(body, pair.steel), pair.contact.plane_depth};
  };
  return {one(pair.upper), one(pair.lower)};
}

HalfSpaces half_spaces_of(const TwoCylinders &pair)
{
  return half_spaces(material_of(pair.upper, pair.steel), material_of(pair.lower, pair.steel));
}

GapShape SpaceShape::gap(const double tilt) const
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
  const double semi = hertz_point(load, radius, 1 / curvature, modulus).semi_y;
  return semi + std::abs(tilt) / curvature <= 0.5 * length;
}

SpaceShape::Slices SpaceShape::slices(const double load, const double tilt) const
{
  constexpr int n     = 400;
  const double slice  = length / n;
  const auto place_of = [&](const int i) { return (i + 0.5) * slice - length / 2; };
  const auto hertz    = hertz_line(load / length, radius, modulus);
  const double stiff  = lundberg_line(hertz, load / length, length, modulus).secant / n;
  const auto carried  = [&](const double approach, Slices &out) {
    double sum = 0;
    out        = {0, 0};
    for (int i = 0; i < n; ++i) {
      const double z = place_of(i), depth = approach - drop(z) + tilt * z;
      if (depth > 0) {
        sum += depth * stiff;
        out.length += slice;
        out.moment += depth * stiff * z;
      }
    }
    return sum;
  };
  Slices out{};
  double least = infinite;  // where the first slice touches
  for (int i = 0; i < n; ++i)
    least = std::min(least, drop(place_of(i)) - tilt * place_of(i));
  double most = least;
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
  s.modulus   = contact_modulus(s.bodies);
  s.radius    = relative_radius(radius_of(pair.upper), radius_of(pair.lower));
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

}  // namespace mill::contact
