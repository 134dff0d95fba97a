#include "app/chatter/chatter_results.h"
#include "core/model/case.h"
#include "core/records/published_quantity.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_chatter.h"
#include "dynamics/chatter/loop.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <functional>
#include <variant>

namespace mill {
namespace {
using dynamics::Verdict;

double apart(const double a, const double b)
{
  return std::abs(a / b - 1);
}

OperatingPoint at_speed(const double speed)
{
  return {"{}", {{speed, "m/s", ".4g"}}};
}

// How far the other linearisations and the other models of the same stand are from the chosen one; without a film
// all linearisations are the same, and a single model gives no estimate of its error.
double spread(const ChatterStudy &s, double dynamics::StandSpeed::*value)
{
  double widest    = 0;
  const auto widen = [&](const std::vector<OtherSearch> &searches) {
    for (const OtherSearch &other : searches)
      if (other.found.verdict == Verdict::crossing)
        widest = std::max(widest, apart(other.found.*value, s.found.*value));
  };
  widen(s.schemes);
  widen(s.structures);
  return widest > 1e-9 ? widest : not_given;
}

// The keys behind the result of a row.
using InputsOf = std::function<KeyList(const ResultRow &)>;

InputsOf inputs_for(const ChatterQuestion &question, const ChatterReading reading)
{
  return [&question, reading](const ResultRow &row) {
    return question.inputs_of ? question.inputs_of(reading, row) : question.inputs;
  };
}

InputsOf inputs_on(const ChatterQuestion &question, const std::string &variant)
{
  const auto named = std::find_if(question.variants.begin(), question.variants.end(),
                                  [&](const NamedStand &one) { return one.name == variant; });
  if (named == question.variants.end() || named->inputs.empty())
    return inputs_for(question, ChatterReading::all);
  return [&inputs = named->inputs](const ResultRow &) { return inputs; };
}

struct ChatterAdder {
  RunContext &run;
  const ChatterStudy &study;
  std::string method;
  OperatingPoint operating_point;
  InputsOf inputs;
  void operator()(const ResultName &name, const double value, const double error = not_given,
                  std::vector<Check> checks = {}) const
  {
    if (std::isnan(value))
      return;
    Parameter p;
    p.value          = value;
    p.unit           = name.row().unit;
    p.method         = method;
    p.at             = operating_point;
    p.error_estimate = error;
    p.checks         = std::move(checks);
    p.inputs         = inputs(name.row());
    run.results.add(name, p);
  }
  void operator()(const RowOf<1> &row, const double value, const double error = not_given,
                  std::vector<Check> checks = {}) const
  {
    (*this)(row.of(study.question.condition.name), value, error, std::move(checks));
  }
};

void add_check(std::vector<Check> &checks, const char *name, const double value, const char *note = "")
{
  if (!std::isnan(value))
    checks.push_back({name, value, note});
}

// The bite of a computed stand has results of the same names by the model of [bite].
bool has_own_bite(const Case &the_case)
{
  const auto *stand = std::get_if<FourHigh>(&the_case.spec);
  return stand && !stand->given.count("K4");
}

void add_bite(RunContext &run, const ChatterStudy &s)
{
  if (!s.working)
    return;
  const RollingCondition &c    = s.question.condition;
  const bite::BiteState &state = s.working->state;
  const ChatterAdder add{run, s, state.model, at_speed(c.speed), inputs_for(s.question, ChatterReading::bite)};
  const auto by_karman = [&](const RowOf<1> &row, const double value, const double karman, const double published,
                             const double measured) {
    if (has_own_bite(run.the_case))
      return;
    std::vector<Check> checks;
    add_check(checks, "slab equation without the simplification of Bland and Ford", karman);
    add_check(checks, name_of(CheckId::published), published, c.note.c_str());
    add_check(checks, name_of(CheckId::measured), measured);
    add(row, value, std::isnan(karman) ? not_given : apart(karman, value), std::move(checks));
  };
  const bite::BiteState none{};
  const bite::BiteState &k = s.karman ? *s.karman : none;
  const auto other         = [&](const double value) { return s.karman ? value : not_given; };
  by_karman(row::bite::force, state.force, other(k.force), c.published_force, c.measured_force);
  // A coefficient that is given is the same in every theory: it would be compared with itself.
  const bool of_bite = follows_bite(s.question.bite.strip.friction);
  by_karman(row::bite::friction, state.friction, of_bite ? other(k.friction) : not_given, c.published_friction,
            not_given);
  by_karman(row::bite::film_thickness, state.film_thickness, other(k.film_thickness), not_given, not_given);
  by_karman(row::bite::flattened_radius, state.flattened_radius, other(k.flattened_radius), not_given, not_given);
  by_karman(row::bite::forward_slip, state.forward_slip, other(k.forward_slip), not_given, not_given);
  by_karman(row::bite::entry_speed, state.entry_speed, other(k.entry_speed), not_given, not_given);
  by_karman(row::bite::exit_speed, state.exit_speed, other(k.exit_speed), not_given, not_given);
  by_karman(row::bite::neutral_position, state.neutral_position, other(k.neutral_position), not_given, not_given);
  by_karman(row::bite::arc_length, state.arc_length, other(k.arc_length), not_given, not_given);
  by_karman(row::bite::torque, state.torque, other(k.torque), not_given, not_given);
  const ChatterAdder slope{
      run, s, std::string("exact derivative, ") + word_of(s.question.analysis.linearisation) + " linearisation",
      at_speed(c.speed), inputs_for(s.question, ChatterReading::slopes)};
  const auto &[P, Q, F, mu, xn] = s.working->by;
  for (int i = 0; i < 5; ++i) {
    slope(row::bite_slope::speed_by[i]->of(c.name, "P"), P[i]);
    slope(row::bite_slope::speed_by[i]->of(c.name, "Q"), Q[i]);
    slope(*row::bite_slope::force_by[i], F[i]);
  }
}

void add_searches(RunContext &run, const ChatterStudy &s, const std::string &group,
                  const row::chatter::Search &rows, const std::vector<OtherSearch> &searches, const bool schemes)
{
  for (const OtherSearch &other : searches) {
    if (other.found.verdict != Verdict::crossing)
      continue;  // its verdict stands in the file of the condition
    const std::string stand  = schemes ? s.question.structure : group + " " + other.name;
    const std::string scheme = schemes ? other.name : word_of(s.question.analysis.linearisation);
    const ChatterAdder add{
        run, s, "eigenvalues of stand, bite and strip; " + stand + ", " + scheme + " linearisation",
        at_speed(other.found.speed),
        schemes ? inputs_for(s.question, ChatterReading::all) : inputs_on(s.question, other.name)};
    const std::string &name = s.question.condition.name;
    add(rows.critical_speed->of(name, other.name), other.found.speed);
    add(rows.frequency->of(name, other.name), other.found.frequency);
    if (other.mode && !other.mode->body.empty())
      add(rows.work_roll_ratio->of(name, other.name), other.mode->work_roll_ratio);
  }
}

// Above what rounding makes of a mode that the bite does not reach.
bool grows(const std::complex<double> &root)
{
  return root.real() > 1e-9 * std::abs(root);
}

// At the working speed: does it grow, and do two methods without eigenvalues agree?
void add_growth(RunContext &run, const ChatterStudy &s, const std::string &method)
{
  const RollingCondition &c = s.question.condition;
  const ChatterAdder working{run, s, method, at_speed(c.speed), inputs_for(s.question, ChatterReading::growth)};
  std::vector<Check> growth, frequency;
  if (s.in_time) {
    add_check(growth, "record of the time simulation", s.in_time->growth);
    add_check(frequency, "record of the time simulation", s.in_time->frequency);
  }
  working(row::chatter::growth_rate, s.growth, not_given, growth);
  if (s.working_mode)
    working(row::chatter::working_frequency, s.working_mode->frequency, not_given, frequency);
  if (s.routh_unstable >= 0 && s.working) {
    const auto roots = dynamics::eigenvalues(dynamics::chatter_matrix(s.question.stand, s.working->by));
    const auto n     = std::count_if(roots.begin(), roots.end(), grows);
    std::vector<Check> checks{{"Routh's array in extended precision", double(s.routh_unstable), ""}};
    if (s.nyquist_unstable >= 0)
      checks.push_back({"Nyquist's criterion", double(s.nyquist_unstable), ""});
    working(row::chatter::unstable_roots, double(n), not_given, checks);
  }
}

void add_stability(RunContext &run, const ChatterStudy &s)
{
  const RollingCondition &c = s.question.condition;
  const std::string system =
      s.question.structure + ", " + word_of(s.question.analysis.linearisation) + " linearisation";
  const ChatterAdder critical{run, s, "eigenvalues of stand, bite and strip; " + system,
                              s.found.verdict == Verdict::crossing ? at_speed(s.found.speed) : OperatingPoint(),
                              inputs_for(s.question, ChatterReading::search)};
  std::vector<Check> checks;
  add_check(checks, "Routh's array in extended precision", s.speed_by_routh);
  for (const OtherSearch &other : s.schemes)
    if (other.name != word_of(s.question.analysis.linearisation))
      add_check(checks, (other.name + " linearisation").c_str(), other.found.speed,
                "the speed depends on what follows a disturbance");
  for (std::size_t i = 1; i < s.structures.size(); ++i)
    add_check(checks, ("on " + s.structures[i].name).c_str(), s.structures[i].found.speed,
              "another model of the stand; the result is that of the most detailed one");
  add_check(checks, name_of(CheckId::published), c.published_critical_speed, c.note.c_str());
  add_check(checks, name_of(CheckId::measured), c.measured_critical_speed);
  if (s.structures.size() > 1)
    critical(row::chatter::critical_speed_highest, band_of(s.structures).high);
  critical(row::chatter::critical_speed, s.found.speed, spread(s, &dynamics::StandSpeed::speed), checks);
  std::vector<Check> frequency;
  if (!std::isnan(s.found.frequency)) {
    const auto peak = std::find_if(s.records.begin(), s.records.end(),
                                   [](const auto &r) { return r.place == HistorySpeed::at; });
    if (peak != s.records.end() && peak->history.gap.size() > 0)
      try {
        add_check(
            frequency, "time simulation at this speed",
            dynamics::mode_near(dynamics::record_modes(peak->history.gap, 1e-4), s.found.frequency).frequency);
      } catch (const SolverError &) {
        // the disturbance did not excite this mode
      }
  }
  critical(row::chatter::frequency, s.found.frequency, spread(s, &dynamics::StandSpeed::frequency), frequency);
  critical(row::chatter::margin, s.found.margin);
  critical(row::chatter::margin_speed, s.found.margin_speed);
  critical(row::chatter::lowest_speed_with_bite, s.found.below.empty() ? not_given : s.found.lowest_bite);

  if (!s.question.speed_assumed)
    add_growth(run, s, critical.method);
  if (s.mode) {
    const ChatterAdder shape{run, s, "eigenvector of the least stable mode; " + system,
                             at_speed(s.found.at ? s.found.speed : c.speed),
                             inputs_for(s.question, ChatterReading::all)};
    shape(row::chatter::work_roll_ratio, s.mode->work_roll_ratio);
    shape(row::chatter::force_phase, s.mode->force_phase);
    shape(row::chatter::entry_tension_phase, s.mode->entry_tension_phase);
    shape(row::chatter::exit_tension_phase, s.mode->exit_tension_phase);
    shape(row::chatter::friction_phase, s.mode->friction_phase);
    const auto &point = s.found.at ? s.found.at : s.working;
    if (point && s.mode->frequency > 0)
      shape(row::chatter::process_damping,
            dynamics::process_damping(s.question.stand, point->by, s.mode->frequency));
  }
  if (s.run && s.cycle.settled && s.cycle.amplitude > 0) {
    const ChatterAdder cycle{run, s, "time simulation with the whole bite; " + system, at_speed(s.run_speed),
                             inputs_for(s.question, ChatterReading::all)};
    cycle(row::chatter::limit_cycle_amplitude, s.cycle.amplitude);
    cycle(row::chatter::limit_cycle_frequency, s.cycle.frequency);
  }
  add_searches(run, s, "scheme", row::chatter::by_scheme, s.schemes, true);
  add_searches(run, s, "variant", row::chatter::of_variant, s.variants, false);
  if (s.structures.size() > 1)
    add_searches(run, s, "structure", row::chatter::of_structure, s.structures, false);
}

// What moves friction, critical speed and growth; NaN ones are left out.
void add_sensitivities(RunContext &run, const ChatterStudy &s)
{
  if (!s.sensitivities)
    return;
  const ChatterAdder working{run, s, "exact derivative d ln / d ln", at_speed(s.question.condition.speed),
                             inputs_for(s.question, ChatterReading::all)};
  const ChatterAdder critical{run, s, "exact derivative d ln / d ln",
                              s.found.verdict == Verdict::crossing ? at_speed(s.found.speed) : OperatingPoint(),
                              inputs_for(s.question, ChatterReading::all)};
  const std::string &name = s.question.condition.name;
  for (const ChatterSensitivity &one : s.sensitivities->inputs) {
    const auto halves = [&](double FiniteChange::*member) {
      std::vector<Check> checks;
      add_check(checks, "from changes of -10 % and +10 %", (one.raised.*member - one.lowered.*member) / 0.2,
                "over a wide span; not accurate where the curve bends");
      return checks;
    };
    working(row::chatter::friction_slope.of(name, one.key), one.friction, not_given,
            halves(&FiniteChange::friction));
    critical(row::chatter::speed_slope.of(name, one.key), one.critical_speed, not_given,
             halves(&FiniteChange::critical_speed));
  }
}

std::string span(double low, double high, const std::string &unit)
{
  const std::string end = unit.empty() ? "" : " " + unit;
  return (low == high ? fmt::format("{:.4g}", low) : fmt::format("{:.4g} .. {:.4g}", low, high)) + end;
}
}  // namespace

std::string verdict_sentence(const ChatterStudy &s)
{
  std::string text = s.question.label + ": " +
                     dynamics::sentence(s.found, {s.question.analysis.speeds[0], s.question.analysis.speeds[1]});
  if (s.structures.size() < 2)
    return text;
  const ModelBand band = band_of(s.structures);
  text += fmt::format("; this is {}, the most detailed of {} models of the stand", s.structures.front().name,
                      s.structures.size());
  if (!std::isnan(band.low))
    text += ", critical speeds " + span(band.low, band.high, "m/s");
  for (const std::string &model : band.without)
    text += "; " + model;
  return text;
}

void add_chatter_results(RunContext &run, const ChatterStudy &s)
{
  const RollingCondition &c = s.question.condition;
  const std::vector<std::string> concerned{result_name({family::chatter, c.name})};
  add_bite(run, s);
  add_stability(run, s);
  add_sensitivities(run, s);
  const double draft = c.entry_thickness - c.exit_thickness;
  if (2 * s.question.analysis.disturbance > 0.05 * draft)
    run.warn({WarningId::growing_histories, s.question.label,
              fmt::format("the histories start with a gap that is open by {:.3g} um, more than a twentieth of the "
                          "draft",
                          2e6 * s.question.analysis.disturbance),
              "linear motion of that size means little (analysis.disturbance)", "", concerned,
              "analysis.disturbance"});
  if (c.entry_tension == 0 || c.exit_tension == 0)
    run.warn({WarningId::slack_strip, s.question.label,
              "a strip without tension goes slack at the first vibration, where the linear model lets its tension "
              "fall below zero",
              "the critical speed is that of a strip that stays under tension", "", concerned});
  for (const std::string &remark : s.remarks)
    run.assume(s.question.label + ": " + remark);
  if (!s.working)
    run.warn({WarningId::no_steady_bite, "",
              fmt::format("{} has no steady bite at its working speed of {:.4g} m/s", s.question.label, c.speed),
              s.no_bite, "", concerned});
  else if (grows(s.working_mode->root) && !s.question.speed_assumed)
    run.warn({WarningId::chatters, "",
              fmt::format("{} chatters at its working speed of {:.4g} m/s", s.question.label, c.speed),
              fmt::format("vibration of {:.4g} Hz doubles in {:.3g} s", s.working_mode->frequency,
                          std::log(2) / s.growth),
              "", concerned});
  if (!s.working)
    return;
  for (Warning note : s.working->state.notes) {
    note.subject  = s.question.label;
    note.concerns = concerned;
    run.warn(std::move(note));
  }
  const double film = s.working->state.film_thickness;
  const bool known  = !std::isnan(s.question.film_range[0]);
  const double e    = s.question.bite.strip.friction.decay;
  const std::array<double, 2> range =
      known ? s.question.film_range : std::array<double, 2>{std::log(1 / 0.95) / e, std::log(1 / 0.05) / e};
  if (!std::isnan(film) && (film < range[0] || film > range[1]))
    run.warn({WarningId::oil_film_range, s.question.label,
              fmt::format("the oil film of {:.3g} um is outside {:.3g} .. {:.3g} um, {}", 1e6 * film,
                          1e6 * range[0], 1e6 * range[1],
                          known ? "over which the friction was measured (oil.film_range)"
                                : "where the friction law still depends on the film (5 to 95 % of mu1)"),
              "", known ? "" : "give oil.film_range if it was measured over other films", concerned,
              "oil.film_range"});
}

std::vector<ChatterPublished> published_rows(const ChatterStudy &s)
{
  const RollingCondition &c = s.question.condition;
  std::vector<ChatterPublished> rows;
  const auto add = [&](const PublishedQuantity quantity, const char *unit, const double here,
                       const double published, const double measured) {
    if (!std::isnan(published) || !std::isnan(measured))
      rows.push_back({word_of(quantity), unit, here, published, measured, c.note});
  };
  add(PublishedQuantity::critical_speed, "m/s", s.found.speed, c.published_critical_speed,
      c.measured_critical_speed);
  add(PublishedQuantity::rolling_force, "kN", s.working ? s.working->state.force / 1e3 : not_given,
      c.published_force / 1e3, c.measured_force / 1e3);
  add(PublishedQuantity::friction, "-", s.working ? s.working->state.friction : not_given, c.published_friction,
      not_given);
  return rows;
}

std::string published_table(const std::vector<ChatterStudy> &studies)
{
  std::string text;
  const auto cell = [](const double x) { return std::isnan(x) ? std::string("-") : fmt::format("{:.5g}", x); };
  const auto off  = [](const double here, const double there) {
    return std::isnan(here) || std::isnan(there) ? std::string("-")
                                                  : fmt::format("{:+.1f} %", 100 * (here / there - 1));
  };
  for (const ChatterStudy &s : studies)
    for (const ChatterPublished &row : published_rows(s))
      text += fmt::format("{:<10} {:<16} {:<5} {:>10} {:>10} {:>9} {:>10} {:>9}\n", s.question.condition.name,
                          row.quantity, row.unit, cell(row.here), cell(row.published),
                          off(row.here, row.published), cell(row.measured), off(row.here, row.measured));
  if (text.empty())
    return text;
  return fmt::format("{:<10} {:<16} {:<5} {:>10} {:>10} {:>9} {:>10} {:>9}\n", "condition", "quantity", "unit",
                     "here", "published", "", "measured", "") +
         text;
}

std::vector<ChatterConclusion> conclusions(const ChatterStudy &s)
{
  std::vector<ChatterConclusion> out;
  if (s.variants.empty() || s.found.verdict != Verdict::crossing || !s.mode)
    return out;
  // the stand itself is one of the variants
  std::vector<const dynamics::StandSpeed *> searches{&s.found};
  std::vector<const dynamics::ChatterMode *> modes{&*s.mode};
  bool all_cross = true;
  for (const OtherSearch &v : s.variants) {
    all_cross = all_cross && v.mode.has_value();
    if (v.mode) {
      searches.push_back(&v.found);
      modes.push_back(&*v.mode);
    }
  }
  const auto [slow, fast] =
      std::minmax_element(searches.begin(), searches.end(), [](auto *a, auto *b) { return a->speed < b->speed; });
  const auto [low, high] = std::minmax_element(searches.begin(), searches.end(),
                                               [](auto *a, auto *b) { return a->frequency < b->frequency; });
  const auto add         = [&](const std::string &text, const bool holds, const std::string &detail) {
    out.push_back({text, holds, detail});
  };
  add("There is a critical speed", all_cross,
      all_cross ? "in every variant" : "one variant has no critical speed in the range searched");
  const bool fitted =
      std::any_of(s.question.variants.begin(), s.question.variants.end(),
                  [&](const NamedStand &v) { return v.stand.entry_distance != s.question.stand.entry_distance; });
  add("The critical speed", (*fast)->speed / (*slow)->speed < 1.05,
      span((*slow)->speed, (*fast)->speed, "m/s") +
          (fitted ? "; the variants also differ in their distances: where these were fitted to this speed, the "
                    "agreement is not evidence"
                  : ""));
  add("The chatter frequency", (*high)->frequency / (*low)->frequency < 1.05,
      span((*low)->frequency, (*high)->frequency, "Hz"));
  const auto same = [&](const auto &question) {
    return std::all_of(modes.begin(), modes.end(), question) || std::none_of(modes.begin(), modes.end(), question);
  };
  const auto extent = [&](double dynamics::ChatterMode::*member, const std::string &unit) {
    const auto [a, b] =
        std::minmax_element(modes.begin(), modes.end(), [&](auto *x, auto *y) { return x->*member < y->*member; });
    return span((*a)->*member, (*b)->*member, unit);
  };
  add("Which work roll moves more", same([](const auto *m) { return m->work_roll_ratio > 1; }),
      "upper over lower " + extent(&dynamics::ChatterMode::work_roll_ratio, ""));
  add("The force is against the gap", same([](const auto *m) { return std::abs(m->force_phase) > 150; }),
      extent(&dynamics::ChatterMode::force_phase, "deg"));
  add("The back tension lags the gap",
      same([](const auto *m) { return std::abs(m->entry_tension_phase + 90) < 60; }),
      extent(&dynamics::ChatterMode::entry_tension_phase, "deg"));
  const bool friction_moves =
      std::all_of(modes.begin(), modes.end(), [](const auto *m) { return std::isfinite(m->force_to_friction); });
  if (friction_moves)  // a constant coefficient has no phase
    add("Friction follows the force", same([](const auto *m) { return std::abs(m->force_to_friction) < 30; }),
        extent(&dynamics::ChatterMode::force_to_friction, "deg"));
  return out;
}
}  // namespace mill
