#include "app/stages/contact/space_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_files.h"
#include "app/stages/contact/space_contact.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/rows_of_contact.h"
#include "fem/contact/hertz.h"
#include "fem/roll/contact_study.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using contact::HertzLine;

const char *const even_load = "even line load over the face";

struct SpaceRun {
  const TwoCylinders &pair;
  SpaceShape shape;
  SpaceAnswer fine, coarse;
  bool point = false, singular = false;
  double load() const
  {
    return pair.space.at;
  }
  double face_load() const  // N/m, mean
  {
    return load() / shape.length;
  }
  HertzLine line() const
  {
    return contact::hertz_line(face_load(), shape.radius, shape.modulus);
  }
  contact::PointContact ellipse() const
  {
    return contact::hertz_point(load(), shape.radius, 1 / shape.curvature, shape.modulus);
  }
  bool long_line() const
  {
    return !point && shape.length > 2 * line().half_width;
  }
};

// Palmgren, (3.10): one contact of a steel roller; m.
double palmgren(const double load, const double length)
{
  return 3.84e-8 * std::pow(load, 0.9) / std::pow(1e3 * length, 0.8);
}

void add(RunContext &run, const SpaceRun &s, const RowOf<0> &row, const double value, const double coarse,
         std::vector<Check> checks, const double safety = mesh_pair_safety)
{
  if (!std::isfinite(value))
    return;
  Parameter p;
  p.value          = value;
  p.unit           = row.unit;
  p.method         = "half spaces, boundary elements (sec. 33.3), between points far from the contact";
  p.at             = {"{}", {{s.load(), "N"}}};
  p.error_estimate = mesh_pair_error(value, coarse, 2, safety);
  if (s.point && !checks.empty())  // Hertz is exact there
    p.error_estimate = std::max(p.error_estimate, difference(checks.front().value, value));
  p.checks = std::move(checks);
  p.checks.push_back({"grid twice as coarse", coarse, ""});
  run.results.add(row.of(), p);
}

// Hertz' ellipse where the faces do not cut it, Hertz' line and Lundberg's approach where the contact is as long
// as the faces.
void add_scalars(RunContext &run, const SpaceRun &s)
{
  const auto &a = s.fine.state, &b = s.coarse.state;
  std::vector<Check> width, pressure, approach, tangent, secant;
  if (s.point) {
    const auto e = s.ellipse();
    width.push_back({"Hertz, ellipse (10.5)", e.semi_x, ""});
    pressure.push_back({"Hertz, ellipse (10.5)", e.peak_pressure, ""});
    approach.push_back({"Hertz, ellipse (10.5)", e.approach, ""});
    tangent.push_back({"Hertz, ellipse (10.5)", e.tangent, ""});
    secant.push_back({"Hertz, ellipse (10.5)", e.secant, ""});
  } else if (s.long_line()) {
    const HertzLine h  = s.line();
    const auto l       = contact::lundberg_line(h, s.face_load(), s.shape.length, s.shape.modulus);
    const double touch = s.shape.first_touch(s.pair.space.tilt);
    width.push_back({"Hertz, line (3.2)", h.half_width, even_load});
    pressure.push_back({"Hertz, line (3.3)", h.peak_pressure, even_load});
    const std::string note =
        touch > 0 ? std::string(even_load) + ", from the first touch of the tilted faces" : std::string(even_load);
    approach.push_back({"Lundberg (33.6)", l.approach + touch, note});
    if (touch == 0)
      approach.push_back(
          {"Palmgren (3.10)", palmgren(s.load(), s.shape.length), "fit to tests with steel rollers, one contact"});
    tangent.push_back({"Lundberg (33.6)", l.tangent, "even line load at every load"});
    secant.push_back({"Lundberg (33.6)", s.load() / (l.approach + touch), note});
  }
  const double hertz = s.point ? s.ellipse().semi_x : s.line().half_width;
  if (hertz > 0.1 * s.shape.radius)
    run.warn({WarningId::half_space_limit,
              "contact.space",
              fmt::format("the half width is {:.2g} of the relative radius", hertz / s.shape.radius),
              "half spaces hold for contacts that are small against their bodies, from a tenth on they are off by "
              "percents",
              "",
              {"contact.space"}});
  add(run, s, row::space::half_width, s.fine.half_width, s.coarse.half_width, width);
  add(run, s, row::space::peak_pressure, s.fine.peak_pressure, s.coarse.peak_pressure, pressure);
  add(run, s, row::space::approach, a.approach, b.approach, approach);
  add(run, s, row::space::tangent, s.fine.tangent, s.coarse.tangent, tangent);
  add(run, s, row::space::secant, a.load / a.approach, b.load / b.approach, secant);
  add(run, s, row::space::loaded_length, s.fine.length, s.coarse.length,
      s.point ? std::vector<Check>{{"Hertz, ellipse (10.5)", 2 * s.ellipse().semi_y, ""}}
      : std::isfinite(s.shape.length) && s.long_line()
          ? std::vector<Check>{{"slices apart (33.7)", s.shape.slices(s.load(), s.pair.space.tilt).length, ""}}
          : std::vector<Check>{});
}

// How uneven the load is along the face; no number where it is the grid's.
void add_edges(RunContext &run, const SpaceRun &s)
{
  if (s.point || !std::isfinite(s.shape.length))
    return;
  if (s.singular) {
    run.warn({WarningId::sharp_end,
              "contact.space",
              "the pressure grows without limit at the sharp end of a face",
              "the approach is that of the body, the largest pressure there is the grid's and is not reported",
              "relieve the ends (profile)",
              {"contact.space"}});
    return;
  }
  const auto ratio = [&](const SpaceAnswer &a) { return a.state.line_load.maxCoeff() / s.face_load(); };
  const auto edge  = [&](const SpaceAnswer &a) { return a.state.peak_pressure.maxCoeff() / a.peak_pressure; };
  add(run, s, row::space::line_load_ratio, ratio(s.fine), ratio(s.coarse), {{"even line load", 1, ""}},
      unseen_order_safety);
  if (s.fine.state.line_load[s.fine.row] > 0)
    add(run, s, row::space::edge_factor, edge(s.fine), edge(s.coarse), {{"even line load", 1, ""}},
        unseen_order_safety);
}

// Moment of the pressures about mid-length, from tilted axes.
void add_moment(RunContext &run, const SpaceRun &s)
{
  const double tilt = s.pair.space.tilt;
  if (!s.fine.grid.half)
    return;
  std::vector<Check> checks;
  if (s.point)
    checks.push_back({"rolling of the crown (33.12)", s.load() * tilt / s.shape.curvature, ""});
  else if (s.long_line())
    checks.push_back({"slices apart (33.11)", s.shape.slices(s.load(), tilt).moment,
                      "slices that do not feel each other deflect more evenly"});
  add(run, s, row::space::moment, s.fine.state.moment, s.coarse.state.moment, checks);
}

void write_length(RunContext &run, const SpaceRun &s)
{
  const auto &a = s.fine.state;
  Table table;
  const Eigen::VectorXd width = a.half_width.unaryExpr([](double b) { return std::isfinite(b) ? b : 0; });
  table.add("z", "m", a.z).add("line_load", "N/m", a.line_load).add("half_width", "m", width);
  table.add("peak_pressure", "Pa", a.peak_pressure);
  write_curve(run, curve::contact_length, "space", table);
}

// Station by station, both sides of the middle across; over both sides along where both were solved.
void write_pressure(RunContext &run, const SpaceRun &s)
{
  const auto &p          = s.fine.state.pressure;
  const Eigen::Index n_x = p.rows(), n_z = p.cols(), n = 2 * n_x * n_z;
  Eigen::VectorXd z(n), x(n), pressure(n);
  for (Eigen::Index j = 0, at = 0; j < n_z; ++j)
    for (Eigen::Index i = 0; i < 2 * n_x; ++i, ++at) {
      const Eigen::Index column = i < n_x ? n_x - 1 - i : i - n_x;
      z[at]                     = s.fine.state.z[j];
      x[at]                     = (i < n_x ? -1 : 1) * s.fine.grid.width * (double(column) + 0.5);
      pressure[at]              = p(column, j);
    }
  Table table;
  table.add("z", "m", z).add("x", "m", x).add("pressure", "Pa", pressure);
  write_curve(run, curve::contact_pressure, "space", table);
  Table across;  // of the row of the scalar results
  Eigen::VectorXd over(2 * n_x), own(2 * n_x);
  for (Eigen::Index i = 0; i < 2 * n_x; ++i) {
    over[i] = x[i];
    own[i]  = pressure[Eigen::Index(s.fine.row) * 2 * n_x + i];
  }
  across.add("x", "m", over).add("pressure", "Pa", own);
  write_curve(run, curve::contact_width, "space", across);
}

// The curve over the swept range, each load on a grid of its own width, compared with the closed form.
double write_sweep(RunContext &run, const SpaceRun &s)
{
  const auto &c = s.pair.space;
  ContactCurve curve;
  curve.load           = fem::log_spaced(c.loads[0], c.loads[1], c.samples);
  const Eigen::Index n = curve.load.size();
  for (auto *column : {&curve.approach, &curve.half_width, &curve.peak_pressure, &curve.tangent, &curve.secant})
    column->resize(n);
  curve.iterations.resize(n);
  Eigen::VectorXd approach(n), tangent(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double load   = curve.load[i];
    const SpaceAnswer a = solve_in_space(s.shape, load, c.tilt, std::max(6, c.rectangles / 2), SpaceRows::graded);
    curve.approach[i]   = a.state.approach;
    curve.half_width[i] = a.half_width;
    curve.peak_pressure[i] = a.peak_pressure;
    curve.tangent[i]       = a.tangent;
    curve.secant[i]        = load / a.state.approach;
    curve.iterations[i]    = a.state.iterations;
    curve.residual         = std::max(curve.residual, a.state.residual);
    if (s.point) {
      const auto e = contact::hertz_point(load, s.shape.radius, 1 / s.shape.curvature, s.shape.modulus);
      approach[i]  = e.approach;
      tangent[i]   = e.tangent;
    } else if (s.long_line()) {
      const double q  = load / s.shape.length;
      const auto h    = contact::hertz_line(q, s.shape.radius, s.shape.modulus);
      const bool fits = s.shape.length > 2 * h.half_width;
      const auto l = fits ? contact::lundberg_line(h, q, s.shape.length, s.shape.modulus) : contact::FiniteLine{};
      approach[i]  = fits ? l.approach + s.shape.first_touch(c.tilt) : not_given;
      tangent[i]   = fits ? l.tangent : not_given;
    }
    run.progress.at("contact space", double(i + 1) / double(n));
  }
  write_curve(run, curve::contact, "space", curve_table(curve, "N", "N/m"));
  if (s.point || s.long_line()) {
    Table closed;
    closed.add("load", "N", curve.load).add("approach", "m", approach).add("tangent", "N/m", tangent);
    write_curve(run, s.point ? curve::contact_hertz : curve::contact_lundberg, "space", closed);
  }
  return curve.residual;
}

void write_slip(RunContext &run, const SpaceSlip &slip, const double mu)
{
  const Eigen::Index n    = slip.contact.place.rows();
  const Eigen::VectorXd t = contact::along_motion(slip.contact, slip.state) / slip.contact.area;
  const Eigen::VectorXd p = slip.state.nodal.head(n) / slip.contact.area;
  Eigen::VectorXd used(n);
  for (Eigen::Index i = 0; i < n; ++i)
    used[i] = p[i] > 0 ? std::hypot(slip.state.nodal[n + i], slip.state.nodal[2 * n + i]) /
                             (mu * slip.contact.area * p[i])
                       : 0;
  Table table;
  table.add("z", "m", slip.contact.place.col(1)).add("x", "m", slip.contact.place.col(0));
  table.add("pressure", "Pa", p).add("shear", "Pa", t).add("used", "", used);
  write_curve(run, curve::contact_slip, "space", table);
}

void solve_slip(RunContext &run, const SpaceRun &s)
{
  const auto &c = s.pair.space;
  if (std::isnan(c.tangential_load))
    return;
  const bool coupled     = s.shape.bodies.coupling != 0;  // twice as many unknowns, in steps
  const SpaceSlip fine   = slip_in_space(s.shape, c, s.fine, coupled ? 12 : 16),
                  coarse = slip_in_space(s.shape, c, s.fine, coupled ? 8 : 10);
  const double share     = c.tangential_load / (c.friction * c.at);
  const bool along       = c.tangential_direction == TangentialDirection::along;
  std::vector<Check> stick, displacement, first, tangent;
  const std::string equal = coupled ? "equal materials: pressure and shear apart" : "";
  if (s.point) {
    const auto e      = contact::mindlin_ellipse(s.ellipse(), s.shape.bodies, c.friction, share, along);
    const char *form  = "Mindlin, ellipse (33.9)";
    const double left = std::cbrt(1 - share);
    stick             = {{form, e.stick_x, equal}};
    displacement      = {{form, e.tangential, equal}};
    first             = {{"no slip (33.8)", e.stiffness, equal}};
    tangent           = {{form, e.stiffness * left, equal}};
  } else if (s.long_line()) {
    stick = {{"Cattaneo, line (33.5)", contact::cattaneo_line(s.line(), share).stick, even_load}};
  }
  const auto put = [&](const RowOf<0> &row, const double value, const double other, std::vector<Check> checks) {
    if (!std::isfinite(value))
      return;
    Parameter p;
    p.value          = value;
    p.unit           = row.unit;
    p.method         = "half spaces with stick and slip (sec. 33.4), between points far from the contact";
    p.at             = {std::string("{}, {} ") + word_of(c.tangential_direction) + " the axes",
                        {{c.at, "N"}, {c.tangential_load, "N"}}};
    p.error_estimate = mesh_pair_error(value, other);
    p.checks         = std::move(checks);
    p.checks.push_back({"coarser grid", other, ""});
    run.results.add(row.of(), p);
  };
  put(row::space::stick_half_width, fine.stick_half_width, coarse.stick_half_width, stick);
  put(row::space::tangential_displacement, fine.displacement, coarse.displacement, displacement);
  put(row::space::tangential_stiffness, fine.first_stiffness, coarse.first_stiffness, first);
  put(row::space::tangential_tangent, fine.tangent, coarse.tangent, tangent);
  write_slip(run, fine, c.friction);
}
}  // namespace

void solve_space(RunContext &run, const TwoCylinders &pair)
{
  StageTimer timer(run, "contact space");
  const auto &c = pair.space;
  SpaceRun s{pair, space_shape(pair), {}, {}, false, false};
  s.point    = s.shape.is_point(c.at, c.tilt);
  s.fine     = solve_in_space(s.shape, c.at, c.tilt, c.rectangles, SpaceRows::refined);
  s.coarse   = solve_in_space(s.shape, c.at, c.tilt, c.rectangles / 2, SpaceRows::refined);
  s.singular = singular_end(s.shape, s.coarse, c.tilt);
  add_scalars(run, s);
  add_edges(run, s);
  add_moment(run, s);
  write_length(run, s);
  write_pressure(run, s);
  solve_slip(run, s);
  const double residual = write_sweep(run, s);
  run.progress.note(fmt::format("contact space: {} loads, {} rectangles, largest complementarity residual {:.1e}",
                                c.samples, s.fine.state.n_unknowns, residual));
}
}  // namespace mill
