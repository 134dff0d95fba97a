#include "fem/contact/space_numbers.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>

namespace mill::contact {
namespace {
HertzLine even_line(const SpaceShape &shape, const double load)
{
  return hertz_line(load / shape.length, shape.radius, shape.modulus);
}

PointContact ellipse_of(const SpaceShape &shape, const double load)
{
  return hertz_point(load, shape.radius, 1 / shape.curvature, shape.modulus);
}

// Palmgren, (3.10): one contact of a steel roller; m.
double palmgren_approach(const double load, const double length)
{
  return 3.84e-8 * std::pow(load, 0.9) / std::pow(1e3 * length, 0.8);
}

// Two grids, of which the coarser has rectangles `ratio` times as large.  No order is known: the first.
class TwoGrids {
public:
  explicit TwoGrids(const double coarser) : ratio(coarser) {}
  SpaceNumber number(const double fine, const double coarse, const double closed,
                     const double safety = mesh_pair_safety) const
  {
    return {fine, coarse, mesh_pair_error(fine, coarse, ratio, safety), closed};
  }
  // The closed form judges both grids where it is exact.
  SpaceNumber judged(const double fine, const double coarse, const double closed, const bool exact) const
  {
    SpaceNumber out = number(fine, coarse, closed);
    if (exact)
      out.error = widened(out.error, closed, fine);
    return out;
  }

private:
  double ratio;
};

// A number of whole cells is not known better than to one of them, m, whatever both grids say.
void widen_by_cell(SpaceNumber &number, const double cell)
{
  number.error += cell / number.value;
}

// How uneven the load is along the face; no number where it is the grid's.
void read_edges(SpaceNumbers &out, const double load, const TwoGrids &grids)
{
  if (out.form == SpaceForm::point || !std::isfinite(out.shape.length) || out.singular)
    return;
  const auto ratio = [&](const SpaceAnswer &a) {
    return a.state.line_load.maxCoeff() / (load / out.shape.length);
  };
  const auto edge     = [](const SpaceAnswer &a) { return a.state.peak_pressure.maxCoeff() / a.peak_pressure; };
  out.line_load_ratio = grids.number(ratio(out.fine), ratio(out.coarse), 1, unseen_order_safety);
  if (out.fine.state.line_load[out.fine.row] > 0)
    out.edge_factor = grids.number(edge(out.fine), edge(out.coarse), 1, unseen_order_safety);
}
}  // namespace

SpaceForm space_form(const SpaceShape &shape, const double load, const double tilt)
{
  if (shape.is_point(load, tilt))
    return SpaceForm::point;
  return shape.length > 2 * even_line(shape, load).half_width ? SpaceForm::line : SpaceForm::none;
}

ClosedSpace closed_space(const SpaceShape &shape, const SpaceForm form, const double load, const double tilt)
{
  if (space_form(shape, load, tilt) != form)
    return {};
  switch (form) {
  case SpaceForm::point: {
    const PointContact e = ellipse_of(shape, load);
    return {e.semi_x, e.peak_pressure, e.approach, e.secant, e.tangent};
  }
  case SpaceForm::line: {
    const HertzLine h     = even_line(shape, load);
    const auto l          = lundberg_line(h, load / shape.length, shape.length, shape.modulus);
    const double approach = l.approach + shape.first_touch(tilt);
    return {h.half_width, h.peak_pressure, approach, load / approach, l.tangent};
  }
  case SpaceForm::none:
    break;
  }
  return {};
}

SpaceNumbers space_numbers(const TwoCylinders &pair)
{
  const auto &c = pair.space;
  SpaceNumbers out{space_shape(pair)};
  const SpaceShape &shape = out.shape;
  out.form                = space_form(shape, c.at, c.tilt);
  out.fine                = solve_in_space(shape, c.at, c.tilt, c.rectangles, SpaceRows::refined);
  out.coarse              = solve_in_space(shape, c.at, c.tilt, c.rectangles / 2, SpaceRows::refined);
  out.singular            = singular_end(shape, out.coarse, c.tilt);
  out.first_touch         = shape.first_touch(c.tilt);
  out.palmgren            = palmgren_approach(c.at, shape.length);
  const bool point = out.form == SpaceForm::point, line = out.form == SpaceForm::line;
  out.hertz_width   = point ? ellipse_of(shape, c.at).semi_x : even_line(shape, c.at).half_width;
  const auto closed = closed_space(shape, out.form, c.at, c.tilt);
  const auto &a = out.fine, &b = out.coarse;
  const auto secant     = [](const SpaceAnswer &answer) { return answer.state.load / answer.state.approach; };
  const bool has_slices = line && std::isfinite(shape.length);
  const auto slices     = has_slices ? shape.slices(c.at, c.tilt) : SpaceShape::Slices{not_given, not_given};
  const TwoGrids grids(b.grid.width / a.grid.width);
  out.half_width      = grids.judged(a.half_width, b.half_width, closed.half_width, point);
  out.peak_pressure   = grids.judged(a.peak_pressure, b.peak_pressure, closed.peak_pressure, point);
  out.approach        = grids.judged(a.state.approach, b.state.approach, closed.approach, point);
  out.tangent         = grids.judged(a.tangent, b.tangent, closed.tangent, point);
  out.secant          = grids.judged(secant(a), secant(b), closed.secant, point);
  const double length = point ? 2 * ellipse_of(shape, c.at).semi_y : slices.length;
  out.length          = grids.judged(a.length, b.length, length, point);
  widen_by_cell(out.length, a.length_step);
  read_edges(out, c.at, grids);
  if (a.grid.half)
    out.moment = grids.judged(a.state.moment, b.state.moment,
                              point ? c.at * c.tilt / shape.curvature : slices.moment, point);
  return out;
}

SpaceCurve space_curve(const TwoCylinders &pair, const SpaceNumbers &numbers, const Eigen::VectorXd &loads,
                       const Progress &progress)
{
  const auto &c           = pair.space;
  const SpaceShape &shape = numbers.shape;
  SpaceCurve out;
  ContactCurve &curve  = out.curve;
  curve.load           = loads;
  const Eigen::Index n = curve.load.size();
  for (auto *column : {&curve.approach, &curve.half_width, &curve.peak_pressure, &curve.tangent, &curve.secant,
                       &out.approach, &out.tangent})
    column->resize(n);
  curve.iterations.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double load      = curve.load[i];
    const SpaceAnswer a    = solve_in_space(shape, load, c.tilt, std::max(6, c.rectangles / 2), SpaceRows::graded);
    curve.approach[i]      = a.state.approach;
    curve.half_width[i]    = a.half_width;
    curve.peak_pressure[i] = a.peak_pressure;
    curve.tangent[i]       = a.tangent;
    curve.secant[i]        = load / a.state.approach;
    curve.iterations[i]    = a.state.iterations;
    curve.residual         = std::max(curve.residual, a.state.residual);
    const auto closed      = closed_space(shape, numbers.form, load, c.tilt);
    out.approach[i]        = closed.approach;
    out.tangent[i]         = closed.tangent;
    progress.at("contact space", double(i + 1) / double(n));
  }
  return out;
}

SpaceSlipNumbers space_slip(const TwoCylinders &pair, const SpaceNumbers &pressed)
{
  const auto &c           = pair.space;
  const SpaceShape &shape = pressed.shape;
  SpaceSlipNumbers out;
  out.coupled          = shape.bodies.coupling != 0;  // twice as many unknowns, in steps
  out.fine             = slip_in_space(shape, c, pressed.fine, out.coupled ? 12 : 16);
  const auto coarse    = slip_in_space(shape, c, pressed.fine, out.coupled ? 8 : 10);
  const double share   = c.tangential_load / (c.friction * c.at);
  double stick         = not_given;
  EllipticSlip ellipse = {not_given, not_given, not_given, not_given};
  if (pressed.form == SpaceForm::point) {
    ellipse = mindlin_ellipse(ellipse_of(shape, c.at), shape.bodies, c.friction, share,
                              c.tangential_direction == TangentialDirection::along);
    stick   = ellipse.stick_x;
  } else if (pressed.form == SpaceForm::line)
    stick = cattaneo_line(even_line(shape, c.at), share).stick;
  const SpaceSlip &fine = out.fine;
  const TwoGrids grids(coarse.contact.width / fine.contact.width);
  out.stick = grids.number(fine.stick_half_width, coarse.stick_half_width, stick);
  widen_by_cell(out.stick, fine.stick_step);
  out.displacement = grids.number(fine.displacement, coarse.displacement, ellipse.tangential);
  out.first        = grids.number(fine.first_stiffness, coarse.first_stiffness, ellipse.stiffness);
  out.tangent      = grids.number(fine.tangent, coarse.tangent, ellipse.stiffness * std::cbrt(1 - share));

  const Eigen::Index n = fine.contact.place.rows();
  const double area    = fine.contact.area;
  const auto &nodal    = fine.state.nodal;
  out.pressure         = nodal.head(n) / area;
  out.shear            = along_motion(fine.contact, fine.state) / area;
  out.friction_share.setZero(n);
  for (Eigen::Index i = 0; i < n; ++i)
    if (out.pressure[i] > 0)
      out.friction_share[i] = std::hypot(nodal[n + i], nodal[2 * n + i]) / (c.friction * area * out.pressure[i]);
  return out;
}
}  // namespace mill::contact
