#include "app/stages/bearing/bearing_published.h"
#include "core/case/bearing_inputs.h"
#include "core/numerics/root_search.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace mill {
namespace {
double published(const BearingStudy &s, const std::string &key)
{
  const auto it = s.question.published.find(key);
  return it == s.question.published.end() ? not_given : it->second.parameter.value;
}

std::string row_key(const Eigen::Index row)
{
  return fmt::format("row{}_roller", row + 1);
}

// Argument in [low, high] at which a function takes the value; NaN: nowhere.
double where(const std::function<double(double)> &f, const double value, const double low, const double high)
{
  return root_between(low, high, [&](const double x) { return f(x) - value; }).value_or(not_given);
}

using Stiffness = bearing::StateNumber;

// Bearing load at which the stiffness of the curve takes the value, linear between its points; NaN: nowhere on it.
double where_on_curve(const std::vector<bearing::AssemblyState> &states, const Stiffness &stiffness,
                      const double value)
{
  for (std::size_t i = 1; i < states.size(); ++i) {
    const double a = stiffness(states[i - 1]), b = stiffness(states[i]);
    if ((a - value) * (b - value) <= 0 && a != b) {
      const double la = states[i - 1].load.head<2>().norm(), lb = states[i].load.head<2>().norm();
      return la + (value - a) / (b - a) * (lb - la);
    }
  }
  return not_given;
}

// The curve beyond its largest load: eight states up to some twenty times it, as far as they have a solution.
std::vector<bearing::AssemblyState> states_beyond(const BearingStudy &s)
{
  std::vector<bearing::RingLoading> loadings;
  auto loading = s.loading;
  for (int i = 1; i <= 8; ++i) {
    loading.value[0] = s.question.loads[s.curve.states.size() - 1] * std::pow(1.45, i);
    loadings.push_back(loading);
  }
  auto states = bearing::BearingAssembly(s.parts.model).curve(loadings).states;
  states.insert(states.begin(), s.curve.states.back());
  return states;
}

// (rows, 2) N, load at which the law of one roller has the published stiffness as secant and as tangent.
Eigen::MatrixXd loads_that_fit(const BearingStudy &s, const Eigen::VectorXd &value)
{
  const auto &law    = s.parts.model.roller;
  const auto secant  = [&](const double load) { return load / bearing::roller_approach(law, load); };
  const auto tangent = [&](const double load) {
    return bearing::roller_load(law, bearing::roller_approach(law, load), 0).stiffness;
  };
  std::string name = "load of a roller";
  for (const double one : value)
    name += fmt::format(" {:a}", one);
  const Eigen::VectorXd fits = s.readings->numbers(name, [&] {
    Eigen::MatrixX2d points(value.size(), 2);
    for (Eigen::Index r = 0; r < value.size(); ++r)
      points.row(r) << where(secant, value[r], 10, 2e5), where(tangent, value[r], 10, 2e5);
    return Eigen::VectorXd(points.reshaped());
  });
  return fits.reshaped(value.size(), 2);
}
}  // namespace

Table published_table(const BearingStudy &s)
{
  const auto rows  = s.at.roller_load.rows();
  const auto heavy = bearing::heaviest_of_rows(s.at);
  Eigen::VectorXd value(rows);
  for (Eigen::Index r = 0; r < rows; ++r)
    value[r] = published(s, row_key(r));
  Table t;
  if (!value.array().isFinite().any())
    return t;
  const Eigen::MatrixXd fit = loads_that_fit(s, value);
  t.add("row", "", Eigen::VectorXd::LinSpaced(rows, 1, double(rows)))
      .add("published", "N/m", value)
      .add("roller_load", "N", heavy.load)
      .add("secant", "N/m", heavy.secant)
      .add("tangent", "N/m", heavy.tangent);
  return t.add("load_that_fits_secant", "N", fit.col(0)).add("load_that_fits_tangent", "N", fit.col(1));
}

void add_published_results(RunContext &run, const std::string &prefix, const BearingStudy &s,
                           const KeysOfRow &inputs)
{
  const RollerBearing &b = s.question.bearing;
  const double total     = published(s, s.question.published_total);
  double sum             = 0;
  for (int r = 0; r < b.rows; ++r)
    sum += published(s, row_key(r));
  Parameter p;
  p.unit         = "N/m";
  p.at           = {"{} on one bearing", {{s.question.radial, "kN"}}};
  const auto add = [&](const RowOf<1> &row, const double value, const std::string &method,
                       std::vector<Check> checks) {
    p.value  = value;
    p.method = method;
    p.checks = std::move(checks);
    p.inputs = inputs(row);
    if (reading_of_bearing(row).asks == BearingAsks::fitted_load)
      p.inputs.push_back("published." + s.question.published_total);
    run.results.add(row.of(prefix), p);
  };
  const auto heavy = bearing::heaviest_of_rows(s.at);
  const double Z5  = b.rollers_per_row / 5.;
  if (std::isfinite(sum)) {
    const double mechanics = b.rollers_per_row * std::pow(std::cos(b.cup_angle), 2) / 4.0847;
    add(row::bearing::rollers_times_Z5, Z5 * heavy.tangent.sum(),
        fmt::format("sum of the heaviest rollers' tangents, one of each row, times Z/5 = {}/5 = {:.4g}: the link "
                    "between the published per-roller values and the published total",
                    b.rollers_per_row, Z5),
        {check(CheckId::published_times_Z5, Z5 * sum, "their own total"),
         check(CheckId::published_total, total, "no contact angle, Z/5 for a bearing with clearance")});
    add(row::bearing::rollers_times_stribeck, mechanics * heavy.tangent.sum(),
        "the same sum times Z cos^2(alpha)/4.085: rigid rings without clearance, (5.15)",
        {check(CheckId::published_times_stribeck, mechanics * sum)});
  }
  if (!std::isfinite(total) || s.curve.states.empty())
    return;
  p.unit = "N";
  p.at   = {"{}", {{total, "kN/mm", ".4g"}}};
  std::vector<bearing::AssemblyState> beyond_curve;
  const auto beyond_it = [&](const std::string &name, const Stiffness &stiffness) {
    return s.readings->numbers(fmt::format("{} {:a} beyond the curve", name, total), [&] {
      if (beyond_curve.empty())
        beyond_curve = states_beyond(s);
      return Eigen::VectorXd::Constant(1, where_on_curve(beyond_curve, stiffness, total));
    })[0];
  };
  const auto fit = [&](const RowOf<1> &row, const std::string &name, const Stiffness &stiffness,
                       const std::string &what) {
    const double load   = where_on_curve(s.curve.states, stiffness, total);
    const double beyond = std::isnan(load) ? beyond_it(name, stiffness) : load;
    const double iso    = where_on_curve(s.standard_curve.states, stiffness, total);
    const double rigid  = where_on_curve(s.rigid_curve.states, stiffness, total);
    if (std::isnan(beyond)) {
      run.assume(
          fmt::format("{}: the {} takes the published {:.4g} kN/mm at no load up to twenty times the swept range",
                      prefix, what, total / 1e6));
      return;
    }
    std::vector<Check> checks;
    if (std::isfinite(iso))
      checks.push_back({"ISO/TS 16281, rigid rings", iso, ""});
    if (std::isfinite(rigid) && b.rings == RingBodies::elastic)
      checks.push_back({"the same rollers, rigid rings", rigid, ""});
    add(row, beyond,
        "bearing load at which the " + what + " takes the published total" +
            (std::isnan(load) ? ", beyond the swept range" : ""),
        std::move(checks));
  };
  fit(
      row::bearing::load_that_fits_tangent, "load_that_fits_tangent",
      [&](const bearing::AssemblyState &state) { return bearing::radial_tangent(state, s.loading); }, "tangent");
  fit(row::bearing::load_that_fits_secant, "load_that_fits_secant", bearing::radial_secant, "secant");
}
}  // namespace mill
