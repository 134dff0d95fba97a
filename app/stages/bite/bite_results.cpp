#include "app/stages/bite/bite_results.h"
#include "app/stages/contact/contact_stage.h"
#include "core/base/force_text.h"
#include "core/base/text.h"
#include "core/records/bite_model.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bite.h"
#include "fem/strip/bite_numbers.h"
#include "reduce/bite/slab/neutral_point.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bite::by;
using bite::Input;

OperatingPoint operating_point(const BiteStudy &s)
{
  const Strip &strip = s.question.bite.strip;
  return OperatingPoint(s.question.pass)
      .add(", {} -> {}, {}", {{strip.entry_thickness, "mm", ".4g"},
                              {strip.exit_thickness, "mm", ".4g"},
                              {s.chosen().state.force, "kN", force_form(s.chosen().state.force)}});
}

Parameter plain(const BiteStudy &s, const BiteAnswer &answer)
{
  Parameter p;
  p.method = model_text(answer);
  p.at     = operating_point(s);
  return p;
}

// The same number by every other model.
std::vector<Check> comparisons(const BiteStudy &s, const std::function<double(const BiteAnswer &)> &same)
{
  std::vector<Check> checks;
  for (const BiteAnswer &answer : s.answers)
    if (answer.refused.empty() && &answer != &s.chosen())
      checks.push_back({model_text(answer), same(answer), ""});
  return checks;
}

double force_in(const BiteAnswer &a)
{
  return a.state.force;
}
double torque_in(const BiteAnswer &a)
{
  return a.state.torque;
}
double slope_in(const BiteAnswer &a)
{
  return a.stiffness.plastic_slope;
}
double slip_in(const BiteAnswer &a)
{
  return a.state.forward_slip;
}
double combined_in(const BiteAnswer &a)
{
  return a.stiffness.combined;
}

// Whether the study has made the section of the work roll, which the backup roll holds.
bool has_section(const BiteStudy &s)
{
  return s.flexibility.position.size() > 0;
}

// What the results of the model that gives K4 read.
BiteReading chosen_reading(const BiteStudy &s, BiteReading reading = {})
{
  reading.section = has_section(s) && fem::on_free_arc(s);
  return reading;
}

struct Adder {
  RunContext &run;
  const BiteStudy &study;
  const BiteKeys &keys;
  void operator()(const RowOf<1> &row, const double value, const double error, std::vector<Check> checks = {},
                  const std::string &more = "") const
  {
    if (std::isnan(value))
      return;
    Parameter p      = plain(study, study.chosen());
    p.unit           = row.unit;
    p.value          = value;
    p.error_estimate = error;
    p.checks         = std::move(checks);
    p.inputs         = keys(chosen_reading(study, reading_of(row, BiteAnswers::model)));
    p.method += more;
    run.results.add(row.of(study.question.pass), p);
  }
};

void add_every_model(RunContext &run, const BiteStudy &s, const BiteKeys &keys)
{
  for (const BiteAnswer &answer : s.answers) {
    if (!answer.refused.empty())
      continue;
    const auto by  = answer.key == word_of(BiteModel::fe) ? BiteAnswers::model : BiteAnswers::compared;
    const auto add = [&](const RowOf<2> &row, const double value) {
      Parameter p         = plain(s, answer);
      BiteReading reading = reading_of(row, by);
      reading.free_arc    = answer.key == word_of(BiteModel::karman_elastic_arc);
      if (by == BiteAnswers::model)
        reading = chosen_reading(s, reading);
      else
        reading.section = reading.free_arc && has_section(s);
      p.inputs = keys(reading);
      p.unit   = row.unit;
      p.value  = value;
      run.results.add(row.of(s.question.pass, answer.key), p);
    };
    add(row::bite_model::force, answer.state.force);
    add(row::bite_model::torque, answer.state.torque);
    add(row::bite_model::forward_slip, answer.state.forward_slip);
    add(row::bite_model::neutral_angle, bite::neutral_angle(s.question.bite, answer.state));
    add(row::bite_model::flattened_radius, answer.state.flattened_radius);
    add(row::bite_model::plastic_slope, answer.stiffness.plastic_slope);
  }
}

void add_balances(RunContext &run, const BiteStudy &s, const BiteKeys &keys)
{
  if (!s.flow)
    return;
  const fem::StripFlow &f = s.flow->fine;
  const auto add          = [&](const RowOf<2> &row, const double value, const char *how) {
    Parameter p = plain(s, *s.find("fe"));
    p.inputs    = keys(chosen_reading(s, reading_of(row, BiteAnswers::model)));
    p.unit      = row.unit;
    p.value     = value;
    p.method += how;
    run.results.add(row.of(s.question.pass, word_of(BiteModel::fe)), p);
  };
  add(row::bite_model::flux_balance, f.balance.flux, ", flow out over flow in minus one");
  add(row::bite_model::force_balance, f.balance.force_x, ", horizontal forces over k h1");
  add(row::bite_model::power_balance, f.balance.power,
      ", power of rolls and tensions over power dissipated minus one");
  add(row::bite_model::exit_thickness, f.exit_thickness, ", of the strip far behind the bite");
  add(row::bite_model::entry_position, f.entry_position, ", where the contact begins");
  add(row::bite_model::exit_position, f.state.exit_position, ", where the contact ends");
  if (!s.flow->elastic)
    return;
  add(row::bite_model::smallest_thickness, s.flow->smallest_thickness, ", of the strip under the rolls");
  add(row::bite_model::elastic_entry, s.flow->elastic_entry, ", contact before the surface of the strip yields");
  add(row::bite_model::elastic_exit, s.flow->elastic_exit, ", contact behind its last yielding");
  add(row::bite_model::elastic_power, s.flow->elastic_power, ", elastic energy carried off over the power spent");
}
}  // namespace

namespace {
// On a free arc strip.exit_thickness is the smallest thickness under load; the strip springs back behind it.
void add_thicknesses(const BiteStudy &s, const Adder &add)
{
  const auto thickness = fem::strip_thickness(s);
  add(row::bite::exit_thickness, thickness.leaving, not_given, {},
      ", of the strip that leaves the stand, under its front tension");
  const bool fe = &s.chosen() == s.find("fe");
  add(row::bite::smallest_thickness, thickness.smallest, not_given, {},
      fe ? ", under the rolls, loaded" : ", under the rolls, loaded: as given");
}
}  // namespace

namespace {
// What chose the solver, theory.md 8.10.
void add_regime(const BiteStudy &s, const Adder &add)
{
  add(row::bite::friction_margin, s.regime.friction_margin, not_given, {},
      ", friction over the least that draws the strip in, by Karman's slab");
  add(row::bite::elastic_share, s.regime.elastic_share, not_given, {},
      ", length of the elastic zones over the arc");
  add(row::bite::arc_over_thickness, s.regime.arc_over_thickness, not_given, {},
      ", of a rigid roll, mean thickness");
}
}  // namespace

BiteKeys keys_of_bite(const RunContext &run, const std::size_t pass)
{
  return [keys = run.keys, pass](const BiteReading &reading) { return bite_keys(*keys, pass, reading); };
}

void add_bite_results(RunContext &run, const BiteStudy &s, const BiteKeys &keys)
{
  const bite::BiteState &state = s.chosen().state;
  const Adder add{run, s, keys};
  const double coarse_force  = s.flow ? s.flow->coarse_force : not_given;
  const double coarse_torque = s.flow ? s.flow->coarse_torque : not_given;
  auto checks                = comparisons(s, force_in);
  if (!std::isnan(s.question.force))
    checks.push_back({s.question.force_name, s.question.force,
                      fem::agrees_with_force(s) || fem::is_fitted(s) ? "" : force_remedy});
  const auto with_measured = [](std::vector<Check> checks, const double value) {
    if (!std::isnan(value))
      checks.push_back(check(CheckId::measured, value));
    return checks;
  };
  const double error = fem::bite_error(s, state.force, coarse_force, force_in);
  add(row::bite::force, state.force, error, std::move(checks));
  add(row::bite::torque, state.torque, fem::bite_error(s, state.torque, coarse_torque, torque_in),
      with_measured(comparisons(s, torque_in), s.question.measured_torque), ", of one roll");
  add(row::bite::friction, state.friction, not_given);
  add(row::bite::film_thickness, state.film_thickness, not_given);
  add(row::bite::flattened_radius, state.flattened_radius, not_given,
      comparisons(s, [](const BiteAnswer &a) { return a.state.flattened_radius; }));
  add(row::bite::arc_length, state.arc_length, not_given);
  add(row::bite::sticking_length, state.sticking_length, not_given);
  add(row::bite::forward_slip, state.forward_slip,
      fem::bite_error(s, state.forward_slip, s.flow ? s.flow->coarse_slip : not_given, slip_in),
      with_measured(comparisons(s, slip_in), s.question.measured_slip));
  const auto neutral = [&](const BiteAnswer &a) { return bite::neutral_angle(s.question.bite, a.state); };
  add(row::bite::neutral_angle, neutral(s.chosen()), not_given, comparisons(s, neutral),
      ", at the axis of the roll: asin of its distance from the line of centres over the roll's own radius");
  add(row::bite::peak_pressure, state.peak_pressure, not_given,
      comparisons(s, [](const BiteAnswer &a) { return a.state.peak_pressure; }));
  add_thicknesses(s, add);
  add(row::bite::entry_speed, state.entry_speed, not_given);
  add(row::bite::exit_speed, state.exit_speed, not_given);
  const std::pair<const RowOf<1> *, Input> inputs[] = {
      {&row::bite::force_by_entry_thickness, Input::entry_thickness},
      {&row::bite::force_by_exit_thickness, Input::exit_thickness},
      {&row::bite::force_by_entry_tension, Input::entry_tension},
      {&row::bite::force_by_exit_tension, Input::exit_tension},
      {&row::bite::force_by_friction, Input::friction},
      {&row::bite::force_by_flow_stress, Input::flow_stress},
      {&row::bite::force_by_roll_speed, Input::roll_speed},
  };
  for (const auto &[row, input] : inputs)
    add(*row, by(state.force_by, input), not_given,
        comparisons(s, [input = input](const BiteAnswer &a) { return by(a.state.force_by, input); }),
        ", exact derivative, arc held");
  add_every_model(run, s, keys);
  add_balances(run, s, keys);
  add_regime(s, add);
}

namespace {
// The path form belongs to the mesh, so its number of nodes stands with it.
void add_path_plateau(const BiteStudy &s, const bite::PathStiffness &path, BiteSpring &spring)
{
  Parameter &p = spring.path_plateau;
  p            = plain(s, *s.find("fe"));
  p.unit       = "N/m";
  p.value      = path.plateau;
  p.method += fmt::format(", nodal force over nodal displacement, {:g} % left out at each end; {} nodes, falls as "
                          "1/nodes",
                          100 * s.question.setup.path_trim, path.nodes);
  spring.flattening.checks = {{"finite elements of the roll's section, sum of nodal forces over mean displacement",
                               path.sum, "reads the mean over the arc, the closed form its middle"}};
  p.checks = {{"sum of nodal forces over mean displacement", path.sum, "does not depend on the mesh"},
              {"flattening of one roll, closed form, over the nodes", spring.flattening.value / path.nodes, ""}};
}
}  // namespace

BiteSpring bite_spring(const BiteStudy &s, const BiteKeys &keys)
{
  const BiteAnswer &chosen = s.chosen();
  const auto numbers       = fem::spring_numbers(s);
  const double dh          = s.question.bite.strip.entry_thickness - s.question.bite.strip.exit_thickness;
  BiteSpring spring;
  spring.plastic_slope                = plain(s, chosen);
  spring.plastic_slope.unit           = "N/m";
  spring.plastic_slope.value          = chosen.stiffness.plastic_slope;
  spring.plastic_slope.error_estimate = numbers.plastic_slope_error;
  spring.plastic_slope.method += ", -dF/dh_exit at fixed entry thickness, arc held";
  spring.plastic_slope.checks = comparisons(s, slope_in);
  if (!std::isnan(chosen.stiffness.plastic_slope_following))
    spring.plastic_slope.checks.push_back(
        {"with the arc following the force", chosen.stiffness.plastic_slope_following, "quasi-static rolls"});
  spring.plastic_slope.checks.push_back({"F / reduction, upper rule of thumb", chosen.state.force / dh, ""});
  spring.plastic_slope.checks.push_back(
      {"F / (2 reduction), lower rule of thumb", chosen.state.force / (2 * dh), ""});

  spring.flattening                = plain(s, chosen);
  spring.flattening.unit           = "N/m";
  spring.flattening.value          = chosen.stiffness.flattening;
  spring.flattening.method         = "closed form, elastic flattening of one roll on the arc of the loaded roll";
  spring.flattening.error_estimate = numbers.flattening_error;
  if (numbers.path)
    add_path_plateau(s, *numbers.path, spring);

  spring.combined        = plain(s, chosen);
  spring.combined.unit   = "N/m";
  spring.combined.value  = chosen.stiffness.combined;
  spring.combined.method = model_text(chosen) + ", plastic slope in series with the flattening of both rolls";
  spring.combined.checks = comparisons(s, combined_in);
  spring.combined.error_estimate = numbers.combined_error;
  for (Parameter *number : {&spring.plastic_slope, &spring.flattening, &spring.combined})
    number->inputs = keys(chosen_reading(s));
  BiteReading path           = chosen_reading(s);
  path.path_trim             = true;
  spring.path_plateau.inputs = keys(path);
  return spring;
}

void add_bite_spring(RunContext &run, const BiteSpring &spring)
{
  run.results.add(row::bite_spring::plastic_slope.of(), spring.plastic_slope);
  run.results.add(row::bite_spring::flattening.of(), spring.flattening);
  run.results.add(row::bite_spring::combined.of(), spring.combined);
  if (!std::isnan(spring.path_plateau.value))
    run.results.add(row::bite_spring::path_plateau.of(), spring.path_plateau);
}

namespace {
std::vector<std::string> concerned_by(const BiteStudy &s)
{
  return {family::bite_spring, result_name({family::bite, s.question.pass})};
}

void note_force(RunContext &run, const BiteStudy &s, const std::string &subject)
{
  if (std::isnan(s.question.force) || s.question.stress_fitted_to_force)
    return;  // a stress that was fitted to the force says nothing of the case
  const double force = s.chosen().state.force;
  const bool fitted  = fem::is_fitted(s);
  const std::string forces =
      fmt::format("{} give {} by {}; {} is {}",
                  fitted ? "the fitted flow stress and friction" : "strip.flow_stress and strip.friction",
                  in_kN(force), model_text(s.chosen()), s.question.force_name, in_kN(s.question.force));
  if (fem::agrees_with_force(s))
    run.assume(subject + ": " + forces);
  else
    run.warn({WarningId::bite_force, subject,
              fmt::format("{}, {:+.0f} %", forces, 100 * (force / s.question.force - 1)),
              "K4 is that of the former", fitted ? "" : force_remedy, concerned_by(s)});
}
}  // namespace

void note_bite(RunContext &run, const BiteStudy &s)
{
  const std::string subject = "bite of " + s.question.pass, where = subject + ": ";
  for (Warning note : s.chosen().state.notes) {
    note.subject  = subject;
    note.concerns = concerned_by(s);
    run.warn(std::move(note));
  }
  for (const std::string &remark : s.chosen().state.remarks)
    run.assume(where + remark);
  if (!s.failures.empty()) {
    std::string causes;
    for (const std::string &failure : s.failures)
      causes += (causes.empty() ? "" : "; ") + failure;
    run.warn({WarningId::bite_model_refused, subject,
              "the value is that of " + model_text(s.chosen()) + ", because the finite elements found no solution",
              causes, "", concerned_by(s)});
  }
  if (!s.slab().refused.empty())
    run.warn({WarningId::bite_model_refused, subject, "the slab theory for comparison has no solution",
              s.slab().refused, "", concerned_by(s)});
  if (fem::on_free_arc(s))
    run.assume(where +
               "strip.exit_thickness is the smallest thickness of the strip under elastic rolls; the strip "
               "springs back from there to bite." +
               s.question.pass + ".exit_thickness");
  if (s.beyond_circle())
    run.warn(s.find("karman-elastic-arc")
                 ? Warning{WarningId::bite_arc_error, subject,
                           "the error estimates include the distance to the free arc, which is not a circle", "",
                           "", concerned_by(s)}
                 : Warning{WarningId::bite_arc_error, subject, "no free arc was found to compare with",
                           "force and K4 are stated without an error estimate", "", concerned_by(s)});
  for (const BiteAnswer &answer : s.answers)
    if (!answer.refused.empty() && answer.key != word_of(BiteModel::fe) && &answer != &s.slab())
      run.assume(where + answer.key + " has no answer: " + answer.refused);
  note_force(run, s, subject);
}
}  // namespace mill
