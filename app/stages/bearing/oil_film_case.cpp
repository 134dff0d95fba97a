#include "app/run/curve_files.h"
#include "app/stages/bearing/oil_film_results.h"
#include "core/base/files.h"
#include "core/case/bearing_inputs.h"
#include "core/numerics/log_spacing.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
using bearing::OilFilmState;
using States = std::vector<std::optional<OilFilmState>>;

// Columns of the states; empty points are NaN.
void add_states(Table &t, const States &states)
{
  const auto column = [&](const auto &read) {
    Eigen::VectorXd out = Eigen::VectorXd::Constant(Eigen::Index(states.size()), not_given);
    for (std::size_t i = 0; i < states.size(); ++i)
      if (states[i])
        out[Eigen::Index(i)] = read(*states[i]);
    return out;
  };
  const auto number = [&](double OilFilmState::*member) {
    return column([member](const OilFilmState &s) { return s.*member; });
  };
  t.add("eccentricity", "", number(&OilFilmState::eccentricity))
      .add("attitude", "rad", number(&OilFilmState::attitude))
      .add("minimum_film", "m", number(&OilFilmState::least_film))
      .add("peak_pressure", "Pa", number(&OilFilmState::peak_pressure))
      .add("temperature", "K", number(&OilFilmState::temperature))
      .add("power_loss", "W", number(&OilFilmState::power_loss))
      .add("side_flow", "m3/s", number(&OilFilmState::side_flow));
  const char *axes[] = {"x", "y"};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const std::string entry = std::string(axes[i]) + axes[j];
      t.add("k_" + entry, "N/m", column([&](const OilFilmState &s) { return s.stiffness(i, j); }));
      t.add("b_" + entry, "N s/m", column([&](const OilFilmState &s) { return s.damping(i, j); }));
    }
}

Eigen::VectorXd vector_of(const std::vector<double> &numbers)
{
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
}

Table film_load_table(const OilFilmStudy &s)
{
  const auto n        = Eigen::Index(s.by_load.size());
  Eigen::VectorXd way = Eigen::VectorXd::Constant(n, not_given), tangent = way;
  for (Eigen::Index i = 0; i < n; ++i)
    if (const auto &state = s.by_load[std::size_t(i)]) {
      way[i]     = s.question.bearing.clearance * state->eccentricity * std::cos(state->attitude);
      tangent[i] = state->stiffness(0, 0);
    }
  const Eigen::VectorXd load = vector_of(s.question.loads);
  Table t;
  t.add("load", "N", load)
      .add("displacement", "m", way)
      .add("secant", "N/m", load.cwiseQuotient(way))
      .add("tangent", "N/m", tangent);
  add_states(t, s.by_load);
  return t;
}

Table film_speed_table(const OilFilmStudy &s)
{
  Table t;
  t.add("speed", "Hz", vector_of(s.question.speeds) / (2 * M_PI));
  add_states(t, s.by_speed);
  return t;
}

// Station by station along the bearing; around, the bush unrolled from the load.
Table film_pressure_table(const OilFilmStudy &s)
{
  const bearing::Film &film     = *s.numbers.solution.film.film;
  const bearing::FilmGrid &grid = film.grid();
  const OilFilmBearing &b       = s.question.bearing;
  const double R                = b.diameter / 2,
               unit = s.numbers.solution.fine.viscosity * s.question.load.speed * std::pow(R / b.clearance, 2);
  std::vector<std::pair<double, Eigen::Index>> order;  // angle from the load, column
  for (Eigen::Index i = 0; i < grid.columns(); ++i)
    order.emplace_back(std::remainder(grid.angle[i], 2 * M_PI), i);
  std::sort(order.begin(), order.end());
  std::vector<Eigen::Index> rows;  // from one end to the other
  if (grid.mirror > 1)
    for (Eigen::Index j = grid.rows() - 1; j > 0; --j)
      rows.push_back(-j);
  for (Eigen::Index j = 0; j < grid.rows(); ++j)
    rows.push_back(j);
  std::vector<double> z, x, p;
  for (const Eigen::Index row : rows)
    for (const auto &[angle, i] : order) {
      const Eigen::Index j = std::abs(row);
      z.push_back((row < 0 ? -1 : 1) * grid.z[j] * b.length / 2);
      x.push_back(R * angle);
      p.push_back(unit * film.pressure()(j, i));
    }
  Table t;
  return t.add("z", "m", vector_of(z)).add("x", "m", vector_of(x)).add("pressure", "Pa", vector_of(p));
}
}  // namespace

void write_oil_film(RunContext &run, const OilFilmStudy &s)
{
  const std::string name = slug(s.question.bearing.name);
  if (!s.by_load.empty())
    write_curve(run, curve::bearing, name, film_load_table(s));
  if (!s.by_speed.empty())
    write_curve(run, curve::bearing_film_speed, name, film_speed_table(s));
  write_curve(run, curve::bearing_film_pressure, name, film_pressure_table(s));
}

void solve_oil_film_case(RunContext &run, const BearingCase &spec, const OilFilmBearing &film)
{
  OilFilmQuestion q;
  q.bearing   = film;
  q.load      = {spec.load.radial, 2 * M_PI * spec.load.speed, {spec.load.tilt, spec.load.tilt_across}};
  q.loads     = evenly_in_logarithm(spec.load.loads[0], spec.load.loads[1], spec.load.samples);
  auto speeds = spec.load.speeds;
  if (std::isnan(speeds[0]))
    speeds = {spec.load.speed / 4, spec.load.speed * 4};
  q.speeds          = evenly_in_logarithm(2 * M_PI * speeds[0], 2 * M_PI * speeds[1], spec.load.samples);
  q.speed_key       = "load.speed";
  const auto study  = study_oil_film(run, q);
  const auto inputs = bearing_case_keys(*run.keys);
  run.results.add(row::bearing::tangent.of(family::bearing), film_stiffness(study, inputs));
  run.results.add(row::bearing::tangent_across.of(family::bearing), film_stiffness(study, inputs, true));
  add_oil_film_results(run, study, inputs, bearing_case_keys(*run.keys, {BearingAsks::least_speed}));
  write_oil_film(run, study);
  note_oil_film(run, study, false);
}
}  // namespace mill
