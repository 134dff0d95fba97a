#include "fem/contact/line_bodies.h"
#include "core/base/errors.h"
#include "fem/contact/half_space.h"
#include "fem/contact/hertz.h"
#include <cmath>

namespace mill::contact {
namespace {
// 2 (1 - nu^2) / (pi E), 1/Pa, eq. (3.1); 0 for a rigid body.
double compliance(const Material &m)
{
  return 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
}
}  // namespace

double half_plane_datum(const LineBody &body)
{
  if (std::isfinite(body.radius))
    return 2 * body.radius / M_E;
  require_input(body.depth > 0, "line contact: an elastic plane needs the depth of its datum point");
  const double nu = body.material.poisson_ratio;
  return body.depth * std::exp(-0.5 - nu / (2 * (1 - nu)));
}

double relative_radius(const double radius1, const double radius2)
{
  return 1 / (1 / radius1 + 1 / radius2);
}

double common_datum(const std::array<LineBody, 2> &bodies)
{
  double sum = 0, weight = 0;
  for (const LineBody &body : bodies)
    if (const double A = compliance(body.material); A > 0) {
      sum += A * std::log(half_plane_datum(body));
      weight += A;
    }
  require_input(weight > 0, "line contact: two rigid bodies have no contact to compute");
  return std::exp(sum / weight);
}

LineApproach line_bodies(const std::array<LineBody, 2> &bodies, const double line_load)
{
  const auto half_space = half_spaces(bodies[0].material, bodies[1].material);
  const double R        = relative_radius(bodies[0].radius, bodies[1].radius);
  require_input(std::isfinite(R), "line contact: one of the two bodies must be round");
  const HertzLine hertz = hertz_line(line_load, R, contact_modulus(half_space));
  LineApproach line{hertz.half_width, hertz.peak_pressure, 0, 0, 0};
  double slope = 0;
  for (const LineBody &body : bodies)
    if (const double A = compliance(body.material); A > 0) {
      const double log = std::log(2 * half_plane_datum(body) / hertz.half_width);
      line.approach += A * line_load * (log + 0.5);  // (33.1)
      slope += A * log;                              // the half width grows with the root of the load
    }
  line.secant  = line_load / line.approach;
  line.tangent = 1 / slope;
  return line;
}
}  // namespace mill::contact
