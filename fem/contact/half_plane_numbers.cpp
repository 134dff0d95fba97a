#include "fem/contact/half_plane_numbers.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include "fem/contact/half_plane_contact.h"
#include "fem/contact/hertz.h"
#include "fem/contact/partial_slip.h"
#include "fem/contact/two_bodies.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mill::contact {
namespace {
constexpr int strips(const bool fine)
{
  return fine ? 161 : 81;  // odd: one in the middle
}

contact::HalfPlanePair half_planes(const TwoCylinders &pair)
{
  const auto bodies = line_bodies_of(pair);
  return {half_spaces_of(pair), relative_radius(bodies[0].radius, bodies[1].radius), common_datum(bodies)};
}

struct SlipState {
  SlipValues values;
  double stick_step;  // m, what one stuck strip more adds to the half width; 0: it is not of whole ones
  LineWidth width;
};

// Pressed first, then pushed sideways in steps: with unlike materials the path matters.
SlipState partial_slip(const TwoCylinders &pair, const bool fine)
{
  const auto &c      = pair.contact;
  const auto planes  = half_planes(pair);
  const double b     = hertz_line(c.at, planes.radius, contact_modulus(planes.bodies)).half_width;
  const int n        = strips(fine);
  const auto problem = strip_contact(
      planes.bodies, [R = planes.radius](const double x) { return x * x / (2 * R); }, 1.25 * b, n, planes.datum,
      c.friction);
  FrictionSolver solver(problem.problem);
  const auto along   = [](const FrictionState &s) { return 1 / s.stiffness.inverse()(1, 1); };
  const auto pressed = solver.advance({Eigen::Vector2d(c.at, 0), {}});
  const double first = along(pressed), start = pressed.motion[1];
  const int steps = planes.bodies.coupling == 0 ? 1 : 8;
  for (int i = 1; i <= steps; ++i)
    solver.advance({Eigen::Vector2d(c.at, c.tangential_load * i / steps), {}});
  const auto &s           = solver.state();
  const Eigen::VectorXd t = s.nodal.tail(n);
  const auto edge         = stick_edge(s, problem.x.cwiseAbs(), t, c.friction, problem.width);
  // Unlike materials leave a stuck zone off the middle, of another shape: its strips are counted.
  const bool coupled = planes.bodies.coupling != 0;
  const double step  = coupled ? 0.5 * problem.width : 0;
  const double stuck = step * double(std::count(s.status.begin(), s.status.end(), Status::stick));
  return {{coupled ? stuck : edge.stick, s.motion[1] - start, first, along(s)},
          step,
          {problem.x, s.nodal.head(n) / problem.width, t / problem.width}};
}

// What Cattaneo's superposition makes of the normal approach: tangential = mu (approach(P) - approach(P - Q /
// mu)).
SlipValues closed_slip(const TwoCylinders &pair)
{
  const auto &c     = pair.contact;
  const auto bodies = line_bodies_of(pair);
  const auto full = line_bodies(bodies, c.at), less = line_bodies(bodies, c.at - c.tangential_load / c.friction);
  const HertzLine hertz{full.half_width, full.peak_pressure};
  return {cattaneo_line(hertz, c.tangential_load / (c.friction * c.at)).stick,
          c.friction * (full.approach - less.approach), full.tangent, less.tangent};
}

}  // namespace

double half_plane_coarsening()
{
  return double(strips(true)) / strips(false);
}

LineValues line_errors(const LineValues &fine, const LineValues &coarse, const double load, const double exact,
                       const double ratio)
{
  const double misfit = std::abs(0.5 * M_PI * fine.half_width * fine.peak_pressure / load - 1);
  return {std::max(mesh_pair_error(fine.half_width, coarse.half_width, ratio), misfit),
          std::max(mesh_pair_error(fine.peak_pressure, coarse.peak_pressure, ratio), misfit),
          mesh_pair_error(fine.approach, coarse.approach, ratio),
          widened(mesh_pair_error(fine.tangent, coarse.tangent, ratio), exact, fine.tangent),
          mesh_pair_error(fine.secant, coarse.secant, ratio)};
}

LineValues half_plane_values(const TwoCylinders &pair, const double line_load, const bool fine)
{
  const auto planes = half_planes(pair);
  const auto s      = half_plane_contact(planes, line_load, strips(fine));
  return {s.half_width, s.peak_pressure, s.approach, half_plane_tangent(planes, line_load, strips(fine)),
          line_load / s.approach};
}

ContactCurve half_plane_curve(const TwoCylinders &pair, const Eigen::VectorXd &loads, const Progress &progress)
{
  const auto planes    = half_planes(pair);
  const Eigen::Index n = loads.size();
  ContactCurve curve;
  curve.name = "line";
  curve.load = loads;
  for (auto *column : {&curve.approach, &curve.half_width, &curve.peak_pressure, &curve.tangent, &curve.secant})
    column->resize(n);
  curve.iterations.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto s           = half_plane_contact(planes, loads[i], strips(false));
    curve.approach[i]      = s.approach;
    curve.half_width[i]    = s.half_width;
    curve.peak_pressure[i] = s.peak_pressure;
    curve.secant[i]        = loads[i] / s.approach;
    curve.tangent[i]       = half_plane_tangent(planes, loads[i], strips(false));
    curve.iterations[i]    = s.iterations;
    curve.residual         = std::max(curve.residual, s.residual);
    progress.at("contact line", double(i + 1) / double(n));
  }
  return curve;
}

LineWidth half_plane_width(const TwoCylinders &pair)
{
  const auto s = half_plane_contact(half_planes(pair), pair.contact.at, strips(true));
  return {s.x, s.pressure, {}};
}

LineSlip half_plane_slip(const TwoCylinders &pair)
{
  const SlipState fine = partial_slip(pair, true);
  const SlipValues &v = fine.values, coarse = partial_slip(pair, false).values;
  const double ratio = half_plane_coarsening();
  const SlipValues error{mesh_pair_error(v.stick, coarse.stick, ratio) + fine.stick_step / v.stick,
                         mesh_pair_error(v.displacement, coarse.displacement, ratio),
                         mesh_pair_error(v.first_stiffness, coarse.first_stiffness, ratio),
                         mesh_pair_error(v.tangent, coarse.tangent, ratio)};
  return {v, coarse, error, closed_slip(pair), half_spaces_of(pair).coupling != 0, fine.width};
}
}  // namespace mill::contact
