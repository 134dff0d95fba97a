#include "app/stages/bearing/bearing_files.h"
#include "app/run/curve_files.h"
#include "app/stages/bearing/bearing_published.h"
#include "core/records/csv.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
using bearing::AssemblyState;

/// (n) one number of every state of a curve; NaN where it ends early.
template <class Read>
Eigen::VectorXd column(const bearing::AssemblyCurve &curve, const Eigen::Index n, const Read &read)
{
  Eigen::VectorXd out = Eigen::VectorXd::Constant(n, not_given);
  for (Eigen::Index i = 0; i < std::min(n, Eigen::Index(curve.states.size())); ++i)
    out[i] = read(curve.states[std::size_t(i)]);
  return out;
}

Table load_table(const BearingStudy &s)
{
  const auto n           = Eigen::Index(s.curve.states.size());
  const auto tangent     = [&](const AssemblyState &state) { return bearing::radial_tangent(state, s.loading); };
  const auto whole       = [](const AssemblyState &state) { return double(state.loaded_rollers.sum()); };
  const auto row_rollers = [](const AssemblyState &state) { return double(state.loaded_rollers.maxCoeff()); };
  Table t;
  t.add("load", "N", Eigen::Map<const Eigen::VectorXd>(s.question.loads.data(), n))
      .add("displacement", "m", column(s.curve, n, [](const AssemblyState &state) { return state.motion[0]; }))
      .add("secant", "N/m", column(s.curve, n, bearing::radial_secant))
      .add("tangent", "N/m", column(s.curve, n, tangent))
      .add("loaded_rollers", "", column(s.curve, n, row_rollers))
      .add("loaded_rollers_all_rows", "", column(s.curve, n, whole))
      .add("roller_max", "N",
           column(s.curve, n, [](const AssemblyState &state) { return state.roller_load.maxCoeff(); }))
      .add("rigid_secant", "N/m", column(s.rigid_curve, n, bearing::radial_secant))
      .add("rigid_tangent", "N/m", column(s.rigid_curve, n, tangent))
      .add("standard_secant", "N/m", column(s.standard_curve, n, bearing::radial_secant))
      .add("standard_tangent", "N/m", column(s.standard_curve, n, tangent));
  for (int r = 0; r < s.question.bearing.rows; ++r)
    t.add(fmt::format("row{}_share", r + 1), "",
          column(s.curve, n, [r](const AssemblyState &state) { return state.row_share[r]; }));
  return t;
}

Table row_table(const BearingStudy &s)
{
  const auto rows  = s.at.row_share.size();
  const auto stiff = bearing::heaviest_of_rows(s.at);
  Table t;
  t.add("row", "", Eigen::VectorXd::LinSpaced(rows, 1, double(rows)))
      .add("share", "", s.at.row_share)
      .add("axial", "N", s.at.row_axial)
      .add("rib_max", "N", s.at.rib_force.rowwise().maxCoeff())
      .add("roller_max", "N", s.at.roller_load.rowwise().maxCoeff())
      .add("roller_secant", "N/m", stiff.secant)
      .add("roller_tangent", "N/m", stiff.tangent);
  return t;
}

Table roller_table(const BearingStudy &s)
{
  Table t;
  t.add("angle", "rad", s.at.azimuth);
  for (Eigen::Index r = 0; r < s.at.roller_load.rows(); ++r)
    t.add(fmt::format("row{}", r + 1), "N", s.at.roller_load.row(r).transpose());
  for (Eigen::Index r = 0; r < s.standard.roller_load.rows(); ++r)
    t.add(fmt::format("standard_row{}", r + 1), "N", s.standard.roller_load.row(r).transpose());
  return t;
}

RollerBearing with_law(RollerBearing b, const OneRollerLaw law)
{
  b.roller_law = law;
  return b;
}

// One roller between its raceways: the law that is used, the contact elements it came from, and the others.
Table law_table(const BearingStudy &s)
{
  const RollerBearing &b = s.question.bearing;
  constexpr int n        = 16;
  double largest         = 1.5 * s.at.roller_load.maxCoeff();
  if (s.parts.roller)
    largest = std::min(largest, largest_contact_load(s.parts));
  Eigen::VectorXd loads(n);
  for (int i = 0; i < n; ++i)
    loads[i] = largest * std::pow(30., double(i) / (n - 1) - 1);
  Table t;
  t.add("load", "N", loads);
  const auto add = [&](const std::string &name, const auto &function) {
    Eigen::VectorXd secant(n), tangent(n);
    for (int i = 0; i < n; ++i) {
      const auto [approach, slope] = function(loads[i]);
      secant[i]                    = loads[i] / approach;
      tangent[i]                   = slope;
    }
    t.add("secant_" + name, "N/m", secant).add("tangent_" + name, "N/m", tangent);
  };
  const auto by_law = [](const bearing::RollerLaw &law) {
    return [&law](const double load) {
      const double approach = bearing::roller_approach(law, load);
      return std::pair(approach, bearing::roller_load(law, approach, 0).stiffness);
    };
  };
  if (s.parts.roller) {
    fem::RollerContact contact(*s.parts.roller, drop_of(b));
    add("fe", [&](const double load) {
      const auto state = contact.solve_load(load);
      return std::pair(state.approach, 1 / state.tangent.inverse()(0, 0));
    });
    add("slices", by_law(s.parts.model.roller));
  }
  for (const OneRollerLaw law : {OneRollerLaw::iso, OneRollerLaw::palmgren, OneRollerLaw::elastic})
    if (law != OneRollerLaw::elastic || std::isfinite(b.bore + b.outside_diameter + b.roller_diameter)) {
      const auto other = bearing::roller_law(with_law(b, law));
      add(word_of(law), by_law(other));
    }
  return t;
}

Table tilt_table(const BearingStudy &s)
{
  constexpr int n       = 9;
  const double approach = bearing::roller_approach(s.parts.model.roller, s.at.roller_load.maxCoeff());
  Eigen::VectorXd tilt  = Eigen::VectorXd::LinSpaced(n, 0, 2e-3), load(n), moment(n), load2(n), moment2(n);
  fem::RollerContact contact(*s.parts.roller, drop_of(s.question.bearing));
  const auto &law = s.parts.model.roller;
  for (int i = 0; i < n; ++i) {
    const auto fe           = contact.solve(approach, tilt[i]);
    const Eigen::VectorXd q = bearing::slice_loads(law, (approach + tilt[i] * law.position.array()).matrix(),
                                                   Eigen::MatrixXd::Zero(law.position.size(), 0))
                                  .load;
    load[i]    = fe.load;
    moment[i]  = fe.moment;
    load2[i]   = q.sum();
    moment2[i] = q.dot(law.position);
  }
  Table t;
  t.add("tilt", "rad", tilt).add("load", "N", load).add("moment", "N m", moment);
  return t.add("load_slices", "N", load2).add("moment_slices", "N m", moment2);
}

// Station by station along the roller, as the pressure of the rolls.
Table pressure_table(const fem::PatchGrid &grid, const fem::RollerSide &side)
{
  const Eigen::Index along = side.pressure.rows(), across = side.pressure.cols();
  Eigen::VectorXd z(along * across), x(along * across), p(along * across);
  for (Eigen::Index k = 0; k < along; ++k)
    for (Eigen::Index i = 0; i < across; ++i) {
      const Eigen::Index from_line = i - (grid.n_x - 1), at = k * across + i;
      z[at] = grid.z[k];
      x[at] = from_line < 0 ? -grid.x[-from_line] : grid.x[from_line];
      p[at] = side.pressure(k, i);
    }
  Table t;
  return t.add("z", "m", z).add("x", "m", x).add("pressure", "Pa", p);
}

// The heaviest roller again by contact elements: its load and its moment, from which its tilt follows.
fem::RollerContactState heaviest_roller(const BearingStudy &s)
{
  Eigen::Index row, roller;
  const double load = s.at.roller_load.maxCoeff(&row, &roller), moment = s.at.roller_moment(row, roller);
  fem::RollerContact contact(*s.parts.roller, drop_of(s.question.bearing));
  double tilt = 0;
  auto state  = contact.solve_load(load, tilt);
  for (int i = 0; i < 6; ++i) {
    const auto &K = state.tangent;
    tilt += (moment - state.moment) / (K(1, 1) - K(1, 0) * K(0, 1) / K(0, 0));
    state = contact.solve_load(load, tilt);
  }
  return state;
}

Table cage_table(const BearingStudy &s)
{
  const auto v = bearing::cage_variation(s.parts.model, s.loading, 16);
  Table t;
  return t.add("angle", "rad", v.angle).add("tangent", "N/m", v.tangent).add("secant", "N/m", v.secant);
}

Table tangent_table(const BearingStudy &s)
{
  Table t;
  const char *names[] = {"x", "y", "z", "about_x", "about_y"}, *units[] = {"m", "m", "m", "rad", "rad"};
  for (int j = 0; j < 5; ++j)
    t.add(std::string("per_") + names[j], std::string("N or N m per ") + units[j], s.at.tangent.col(j));
  return t;
}
}  // namespace

void write_load_curve(RunContext &run, const BearingStudy &s)
{
  write_curve(run, curve::bearing, slug(s.question.bearing.name), load_table(s));
}

void write_bearing(RunContext &run, const BearingStudy &s)
{
  const std::string name = slug(s.question.bearing.name);
  if (!s.curve.states.empty())
    write_load_curve(run, s);
  write_curve(run, curve::bearing_rows, name, row_table(s));
  write_curve(run, curve::bearing_rollers, name, roller_table(s));
  BearingReadings &readings = *s.readings;
  write_curve(run, curve::bearing_law, name, readings.table("law", [&] { return law_table(s); }));
  write_curve(run, curve::bearing_tangent, name, tangent_table(s));
  write_curve(run, curve::bearing_cage, name, readings.table("cage", [&] { return cage_table(s); }));
  if (s.parts.roller && s.at.roller_load.maxCoeff() > largest_contact_load(s.parts))
    run.warn({WarningId::bearing_pressure_map, "bearing " + s.question.bearing.name,
              fmt::format("the heaviest roller carries {:.4g} kN, contact elements are meshed up to {:.4g} kN "
                          "(4.5 GPa at most)",
                          s.at.roller_load.maxCoeff() / 1e3, largest_contact_load(s.parts) / 1e3),
              "its pressure map and its tilt are left out"});
  else if (s.parts.roller) {
    write_curve(run, curve::bearing_tilt, name, readings.table("tilt", [&] { return tilt_table(s); }));
    std::optional<fem::RollerContactState> heaviest;
    const auto pressure = [&](const char *side, fem::RollerSide fem::RollerContactState::*side_state) {
      return readings.table(side, [&] {
        if (!heaviest)
          heaviest = heaviest_roller(s);
        return pressure_table(s.parts.roller->grid, (*heaviest).*side_state);
      });
    };
    write_curve(run, curve::bearing_pressure_inner, name, pressure("inner", &fem::RollerContactState::inner));
    write_curve(run, curve::bearing_pressure_outer, name, pressure("outer", &fem::RollerContactState::outer));
  }
  if (const Table published = published_table(s); !published.columns.empty())
    write_curve(run, curve::bearing_published, name, published);
}
}  // namespace mill
