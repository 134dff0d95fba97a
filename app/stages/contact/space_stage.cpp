#include "app/stages/contact/space_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_files.h"
#include "core/case/contact_inputs.h"
#include "core/records/rows_of_contact.h"
#include "fem/contact/space_numbers.h"
#include "fem/roll/contact_study.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using contact::SpaceForm;
using contact::SpaceNumber;
using contact::SpaceNumbers;

const char *const even_load = "even line load over the face";

// The closed form first, then others, then the coarser grid.
void add(RunContext &run, const RowOf<0> &row, Parameter p, const SpaceNumber &number, std::vector<Check> checks,
         const char *coarser)
{
  if (!std::isfinite(number.value))
    return;
  p.value          = number.value;
  p.unit           = row.unit;
  p.error_estimate = number.error;
  p.checks         = std::move(checks);
  p.checks.push_back({coarser, number.coarse, ""});
  run.results.add(row.of(), p);
}

std::vector<Check> compared(const SpaceNumber &number, const std::string &form, const std::string &note = "")
{
  if (std::isnan(number.closed))
    return {};
  return {{form, number.closed, note}};
}

void add_pressed(RunContext &run, const RowOf<0> &row, const double load, const SpaceNumber &number,
                 std::vector<Check> checks)
{
  Parameter p;
  p.method = "half spaces, boundary elements (sec. 33.3), between points far from the contact";
  p.at     = {"{}", {{load, "N"}}};
  p.inputs = cylinder_keys(*run.keys, BodyReading::pressed);
  add(run, row, p, number, std::move(checks), "grid twice as coarse");
}

void add_scalars(RunContext &run, const TwoCylinders &pair, const SpaceNumbers &s)
{
  const double load = pair.space.at, touch = s.first_touch;
  const bool point = s.form == SpaceForm::point;
  if (s.hertz_width > 0.1 * s.shape.radius)
    run.warn({WarningId::half_space_limit,
              "contact.space",
              fmt::format("the half width is {:.2g} of the relative radius", s.hertz_width / s.shape.radius),
              "half spaces hold for contacts that are small against their bodies, from a tenth on they are off by "
              "percents",
              "",
              {"contact.space"}});
  const std::string ellipse = "Hertz, ellipse (10.5)", lundberg = "Lundberg (33.6)";
  const std::string load_note  = point ? "" : even_load,
                    touch_note = point ? ""
                                 : touch > 0
                                     ? std::string(even_load) + ", from the first touch of the tilted faces"
                                     : even_load;
  auto approach                = compared(s.approach, point ? ellipse : lundberg, touch_note);
  if (s.form == SpaceForm::line && touch == 0)
    approach.push_back({"Palmgren (3.10)", s.palmgren, "fit to tests with steel rollers, one contact"});
  add_pressed(run, row::space::half_width, load, s.half_width,
              compared(s.half_width, point ? ellipse : "Hertz, line (3.2)", load_note));
  add_pressed(run, row::space::peak_pressure, load, s.peak_pressure,
              compared(s.peak_pressure, point ? ellipse : "Hertz, line (3.3)", load_note));
  if (std::isnan(s.peak_pressure.value))
    run.assume(
        "contact.space: nothing is carried at mid-length, so half width and peak pressure there are left out; "
        "the pressures along the contact are in curves/contact-space-length.csv");
  add_pressed(run, row::space::approach, load, s.approach, std::move(approach));
  add_pressed(run, row::space::tangent, load, s.tangent,
              compared(s.tangent, point ? ellipse : lundberg, point ? "" : "even line load at every load"));
  add_pressed(run, row::space::secant, load, s.secant, compared(s.secant, point ? ellipse : lundberg, touch_note));
  add_pressed(run, row::space::loaded_length, load, s.length,
              compared(s.length, point ? ellipse : "slices apart (33.7)"));
}

void add_edges(RunContext &run, const TwoCylinders &pair, const SpaceNumbers &s)
{
  if (s.form != SpaceForm::point && std::isfinite(s.shape.length) && s.singular)
    run.warn({WarningId::sharp_end,
              "contact.space",
              "the pressure grows without limit at the sharp end of a face",
              "the approach is that of the body, the largest pressure there is the grid's and is not reported",
              "relieve the ends (profile)",
              {"contact.space"}});
  add_pressed(run, row::space::line_load_ratio, pair.space.at, s.line_load_ratio,
              compared(s.line_load_ratio, "even line load"));
  add_pressed(run, row::space::edge_factor, pair.space.at, s.edge_factor,
              compared(s.edge_factor, "even line load"));
  if (s.moment)
    add_pressed(run, row::space::moment, pair.space.at, *s.moment,
                s.form == SpaceForm::point ? compared(*s.moment, "rolling of the crown (33.12)")
                                           : compared(*s.moment, "slices apart (33.11)",
                                                      "slices that do not feel each other deflect more evenly"));
}

void write_length(RunContext &run, const SpaceNumbers &s)
{
  const auto &a = s.fine.state;
  Table table;
  const Eigen::VectorXd width = a.half_width.unaryExpr([](double b) { return std::isfinite(b) ? b : 0; });
  table.add("z", "m", a.z).add("line_load", "N/m", a.line_load).add("half_width", "m", width);
  table.add("peak_pressure", "Pa", a.peak_pressure);
  write_curve(run, curve::contact_length, "space", table);
}

// Station by station, both sides of the middle across; over both sides along where both were solved.
void write_pressure(RunContext &run, const SpaceNumbers &s)
{
  const auto &p          = s.fine.state.pressure;
  const Eigen::Index n_x = p.rows(), n_z = p.cols(), n = 2 * n_x * n_z;
  Eigen::VectorXd z(n), x(n), pressure(n);
  for (Eigen::Index j = 0, k = 0; j < n_z; ++j)
    for (Eigen::Index i = 0; i < 2 * n_x; ++i, ++k) {
      const Eigen::Index column = i < n_x ? n_x - 1 - i : i - n_x;
      z[k]                      = s.fine.state.z[j];
      x[k]                      = (i < n_x ? -1 : 1) * s.fine.grid.width * (double(column) + 0.5);
      pressure[k]               = p(column, j);
    }
  Table table;
  table.add("z", "m", z).add("x", "m", x).add("pressure", "Pa", pressure);
  write_curve(run, curve::contact_pressure, "space", table);
  Table across;  // of the row of the scalar results
  Eigen::VectorXd over(2 * n_x), in_row(2 * n_x);
  for (Eigen::Index i = 0; i < 2 * n_x; ++i) {
    over[i]   = x[i];
    in_row[i] = pressure[Eigen::Index(s.fine.row) * 2 * n_x + i];
  }
  across.add("x", "m", over).add("pressure", "Pa", in_row);
  write_curve(run, curve::contact_width, "space", across);
}

// The curve, compared with the closed form.
double write_sweep(RunContext &run, const TwoCylinders &pair, const SpaceNumbers &s)
{
  const auto &c = pair.space;
  const auto [curve, approach, tangent] =
      contact::space_curve(pair, s, fem::log_spaced(c.loads[0], c.loads[1], c.samples), run.progress);
  write_curve(run, curve::contact, "space", curve_table(curve, "N", "N/m"));
  if (s.form != SpaceForm::none) {
    Table closed;
    closed.add("load", "N", curve.load).add("approach", "m", approach).add("tangent", "N/m", tangent);
    write_curve(run, s.form == SpaceForm::point ? curve::contact_hertz : curve::contact_lundberg, "space", closed);
  }
  return curve.residual;
}

void solve_slip(RunContext &run, const TwoCylinders &pair, const SpaceNumbers &pressed)
{
  const auto &c = pair.space;
  if (std::isnan(c.tangential_load))
    return;
  const auto s            = contact::space_slip(pair, pressed);
  const std::string equal = s.coupled ? "equal materials: pressure and shear apart" : "";
  const std::string form  = "Mindlin, ellipse (33.9)";
  const auto put          = [&](const RowOf<0> &row, const SpaceNumber &number, std::vector<Check> checks) {
    Parameter p;
    p.method = "half spaces with stick and slip (sec. 33.4), between points far from the contact";
    p.at     = {std::string("{}, {} ") + word_of(c.tangential_direction) + " the axes",
                {{c.at, "N"}, {c.tangential_load, "N"}}};
    p.inputs = cylinder_keys(*run.keys, BodyReading::slip);
    add(run, row, p, number, std::move(checks), "coarser grid");
  };
  put(row::space::stick_half_width, s.stick,
      pressed.form == SpaceForm::point ? compared(s.stick, form, equal)
                                       : compared(s.stick, "Cattaneo, line (33.5)", even_load));
  put(row::space::tangential_displacement, s.displacement, compared(s.displacement, form, equal));
  put(row::space::tangential_stiffness, s.first, compared(s.first, "no slip (33.8)", equal));
  put(row::space::tangential_tangent, s.tangent, compared(s.tangent, form, equal));
  Table table;
  table.add("z", "m", s.fine.contact.place.col(1)).add("x", "m", s.fine.contact.place.col(0));
  table.add("pressure", "Pa", s.pressure).add("shear", "Pa", s.shear).add("used", "", s.friction_share);
  write_curve(run, curve::contact_slip, "space", table);
}
}  // namespace

void solve_space(RunContext &run, const TwoCylinders &pair)
{
  StageTimer timer(run, "contact space");
  const SpaceNumbers s = contact::space_numbers(pair);
  add_scalars(run, pair, s);
  add_edges(run, pair, s);
  write_length(run, s);
  write_pressure(run, s);
  solve_slip(run, pair, s);
  const double residual = write_sweep(run, pair, s);
  run.progress.note(fmt::format("contact space: {} loads, {} rectangles, largest complementarity residual {:.1e}",
                                pair.space.samples, s.fine.state.n_unknowns, residual));
}
}  // namespace mill
