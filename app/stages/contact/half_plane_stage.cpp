#include "app/stages/contact/half_plane_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/body_pair.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/rows_of_contact.h"
#include "fem/contact/half_plane_contact.h"
#include "fem/contact/hertz.h"
#include "fem/contact/partial_slip.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr int strips(const bool fine)
{
  return fine ? 161 : 81;  // odd: one in the middle
}

contact::HalfPlanePair half_planes(const TwoCylinders &pair)
{
  const auto bodies = line_bodies_of(pair);
  return {half_spaces_of(pair), contact::relative_radius(bodies[0].radius, bodies[1].radius),
          contact::common_datum(bodies)};
}

struct SlipValues {
  double stick, displacement, first_stiffness, tangent;
  Eigen::VectorXd x, pressure, shear;
};

// Pressed first, then pushed sideways in steps: with unlike materials the path matters.
SlipValues partial_slip(const TwoCylinders &pair, const bool fine)
{
  const auto &c     = pair.contact;
  const auto planes = half_planes(pair);
  const double b    = contact::hertz_line(c.at, planes.radius, contact::contact_modulus(planes.bodies)).half_width;
  const int n       = strips(fine);
  const auto problem = contact::strip_contact(
      planes.bodies, [R = planes.radius](const double x) { return x * x / (2 * R); }, 1.25 * b, n, planes.datum,
      c.friction);
  contact::FrictionSolver solver(problem.problem);
  const auto along   = [](const contact::FrictionState &s) { return 1 / s.stiffness.inverse()(1, 1); };
  const auto pressed = solver.advance({Eigen::Vector2d(c.at, 0), {}});
  const double first = along(pressed), start = pressed.motion[1];
  const int steps = planes.bodies.coupling == 0 ? 1 : 8;
  for (int i = 1; i <= steps; ++i)
    solver.advance({Eigen::Vector2d(c.at, c.tangential_load * i / steps), {}});
  const auto &s           = solver.state();
  const Eigen::VectorXd t = s.nodal.tail(n);
  const auto edge         = contact::stick_edge(s, problem.x.cwiseAbs(), t, c.friction, problem.width);
  // Unlike materials leave a stuck zone off the middle, of another shape: its strips are counted.
  const double stuck =
      0.5 * problem.width * double(std::count(s.status.begin(), s.status.end(), contact::Status::stick));
  return {planes.bodies.coupling == 0 ? edge.stick : stuck,
          s.motion[1] - start,
          first,
          along(s),
          problem.x,
          s.nodal.head(n) / problem.width,
          t / problem.width};
}

// What Cattaneo's superposition makes of the normal approach: tangential = mu (approach(P) - approach(P - Q /
// mu)).
struct ClosedSlip {
  double stick, displacement, first_stiffness, tangent;
};
ClosedSlip closed_slip(const TwoCylinders &pair)
{
  const auto &c     = pair.contact;
  const auto bodies = line_bodies_of(pair);
  const auto full   = contact::line_bodies(bodies, c.at),
             less   = contact::line_bodies(bodies, c.at - c.tangential_load / c.friction);
  const contact::HertzLine hertz{full.half_width, full.peak_pressure};
  return {contact::cattaneo_line(hertz, c.tangential_load / (c.friction * c.at)).stick,
          c.friction * (full.approach - less.approach), full.tangent, less.tangent};
}

void add_slip(RunContext &run, const TwoCylinders &pair, const SlipValues &s)
{
  const SlipValues coarse = partial_slip(pair, false);
  const ClosedSlip closed = closed_slip(pair);
  const bool coupled      = half_spaces_of(pair).coupling != 0;
  const auto add = [&](const RowOf<0> &row, const double value, const double other, const std::string &form,
                       const double check) {
    Parameter p;
    p.value  = value;
    p.unit   = row.unit;
    p.method = "half planes with stick and slip (sec. 33.4), displacements with the datum of the normal approach";
    p.at     = {"{}, {} across", {{pair.contact.at, "N/mm"}, {pair.contact.tangential_load, "N/mm"}}};
    p.error_estimate = mesh_pair_error(value, other);
    p.checks         = {{form, check, coupled ? "equal materials: pressure and shear apart" : ""},
                        {"strips twice as wide", other, ""}};
    run.results.add(row.of(), p);
  };
  add(row::line::stick_half_width, s.stick, coarse.stick, "Cattaneo (33.5)", closed.stick);
  add(row::line::tangential_displacement, s.displacement, coarse.displacement, "Cattaneo (33.10)",
      closed.displacement);
  add(row::line::tangential_stiffness, s.first_stiffness, coarse.first_stiffness, "no slip (33.10)",
      closed.first_stiffness);
  add(row::line::tangential_tangent, s.tangent, coarse.tangent, "Cattaneo (33.10)", closed.tangent);
}
}  // namespace

LineValues half_plane_values(const TwoCylinders &pair, const double line_load, const bool fine)
{
  const auto planes = half_planes(pair);
  const auto s      = contact::half_plane_contact(planes, line_load, strips(fine));
  return {s.half_width, s.peak_pressure, s.approach, contact::half_plane_tangent(planes, line_load, strips(fine)),
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
    const auto s           = contact::half_plane_contact(planes, loads[i], strips(false));
    curve.approach[i]      = s.approach;
    curve.half_width[i]    = s.half_width;
    curve.peak_pressure[i] = s.peak_pressure;
    curve.secant[i]        = loads[i] / s.approach;
    curve.tangent[i]       = contact::half_plane_tangent(planes, loads[i], strips(false));
    curve.iterations[i]    = s.iterations;
    curve.residual         = std::max(curve.residual, s.residual);
    progress.at("contact line", double(i + 1) / double(n));
  }
  return curve;
}

void solve_over_width(RunContext &run, const TwoCylinders &pair)
{
  Table table;
  if (std::isnan(pair.contact.tangential_load)) {
    const auto s = contact::half_plane_contact(half_planes(pair), pair.contact.at, strips(true));
    table.add("x", "m", s.x).add("pressure", "Pa", s.pressure);
  } else {
    const SlipValues s = partial_slip(pair, true);
    table.add("x", "m", s.x).add("pressure", "Pa", s.pressure).add("shear", "Pa", s.shear);
    table.add("friction_limit", "Pa", pair.contact.friction * s.pressure);
    add_slip(run, pair, s);
  }
  write_curve(run, curve::contact_width, "line", table);
}
}  // namespace mill
