#include "fem/contact/half_plane_contact.h"
#include "fem/contact/active_set.h"
#include "fem/contact/half_space_contact.h"
#include "fem/contact/hertz.h"
#include "fem/contact/partial_slip.h"
#include <cmath>

namespace mill::contact {
HalfPlaneState half_plane_contact(const HalfPlanePair &pair, const double line_load, const int n)
{
  const double b   = hertz_line(line_load, pair.radius, contact_modulus(pair.bodies)).half_width;
  const auto strip = strip_contact(
      pair.bodies, [R = pair.radius](const double x) { return x * x / (2 * R); }, 1.25 * b, n, pair.datum, 0);
  Problem p;
  p.C           = strip.problem.C.topLeftCorner(n, n);
  p.G           = Eigen::MatrixXd::Ones(n, 1);
  p.initial_gap = strip.problem.initial_gap;
  const State s = ActiveSet(std::move(p)).solve({Eigen::VectorXd::Constant(1, line_load), {}});
  HalfPlaneState out;
  out.approach   = s.motion[0];
  out.x          = strip.x;
  out.pressure   = s.nodal / strip.width;
  out.iterations = s.iterations;
  out.residual   = s.residual;
  std::vector<double> x, pressure;  // of the half x > 0, from the middle
  for (int i = n / 2; i < n && out.pressure[i] > 0; ++i) {
    x.push_back(out.x[i]);
    pressure.push_back(out.pressure[i]);
  }
  const PressureFit fit = fit_pressure(x, pressure);
  out.half_width        = fit.half_width;
  out.peak_pressure     = fit.peak;
  return out;
}

double half_plane_tangent(const HalfPlanePair &pair, const double line_load, const int n)
{
  return smooth_tangent(line_load, [&](const double load) { return half_plane_contact(pair, load, n).approach; });
}
}  // namespace mill::contact
