#include "app/twin/advice/critical_speed_advice.h"
#include "app/chatter/chatter_question.h"
#include "app/twin/stand/chatter_model.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using twin::CriticalAdvice;
using twin::CriticalQuestion;
using twin::RatedAction;

// The condition that is nearest to its critical speed, or the one that is named.
std::size_t asked_condition(const ChatterCase &spec)
{
  std::size_t nearest = 0;
  double least        = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < spec.conditions.size(); ++i) {
    if (spec.conditions[i].name == spec.advice.condition)
      return i;
    const ChatterQuestion q = chatter_question(spec, i);
    const auto state        = twin::critical_state(q.stand, q.bite, q.scheme, chatter_range(q), q.condition.speed);
    if (state.no_bite)
      continue;
    if (const double ratio = state.speed / q.condition.speed; ratio < least) {
      least   = ratio;
      nearest = i;
    }
  }
  return nearest;
}

// Numbers of the stand by the keys of dynamics::StructureNumber: "stand.masses[2]", "K3",
// "dynamics.modal_damping".
void scale(ChatterCase &spec, const std::string &key, const double factor)
{
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string number = fmt::format("[{}]", i);
    if (key == "stand.stiffnesses" + number) {
      spec.stand.stiffnesses[i] *= factor;
      if (spec.model)
        spec.model->K[i < 3 ? i : i + 1].value *= factor;  // K4 is the bite's
    } else if (key == "stand.dampings" + number)
      spec.stand.dampings[i] *= factor;
  }
  if (spec.model)
    for (std::size_t j = 0; j < spec.model->K.size(); ++j)
      if (key == fmt::format("K{}", j + 1))
        spec.model->K[j].value *= factor;
  if (key == "dynamics.modal_damping")
    spec.modal_damping *= factor;
}

// Of the six springs of a chatter stand the one that is spring j of a lumped model; K4 is the bite's.
std::string spring_key(const std::size_t j)
{
  return j == 3 ? "" : fmt::format("stand.stiffnesses[{}]", j < 3 ? j : j - 1);
}

ProcessAdvice process_of(const ChatterAdvice &asked)
{
  ProcessAdvice process;
  process.wanted_speed    = asked.wanted_speed;
  process.force_rise      = asked.force_rise;
  process.torque_rise     = asked.torque_rise;
  process.speed           = asked.speed;
  process.entry_thickness = asked.entry_thickness;
  process.entry_tension   = asked.entry_tension;
  process.exit_tension    = asked.exit_tension;
  process.viscosity       = asked.viscosity;
  process.friction        = {1, 1};
  return process;
}

CriticalQuestion question_of(const ChatterCase &spec, const std::size_t condition)
{
  const ChatterQuestion chatter = chatter_question(spec, condition);
  CriticalQuestion q;
  static_cast<twin::ChatterModel &>(q) = chatter_model(chatter);
  q.working_speed                      = chatter.condition.speed;
  q.margin                             = spec.advice.margin;
  q.process                            = process_of(spec.advice);
  q.stiffness                          = spec.advice.stiffness;
  q.damping                            = spec.advice.damping;
  if (spec.model)
    for (std::size_t j = 0; j < spec.model->K.size(); ++j)
      for (const std::string &key : {fmt::format("K{}", j + 1), spring_key(j)})
        if (const double error = spec.model->K[j].error_estimate; std::isfinite(error) && !key.empty())
          q.doubts.push_back({key, error, false});
  q.changed = [&spec, condition](const twin::StructureChanges &changes) {
    ChatterCase changed = spec;
    for (const auto &[key, factor] : changes)
      scale(changed, key, factor);
    ChatterQuestion after = chatter_question(changed, condition);
    return twin::NumberedStructure{std::move(after.stand.structure), std::move(after.numbers)};
  };
  return q;
}

std::string speed_words(const twin::CriticalState &state)
{
  using dynamics::Verdict;
  if (state.at_least)
    return fmt::format("none up to {:.4g} m/s", state.speed);
  if (state.found.verdict == Verdict::crossing)
    return fmt::format("{:.3f} m/s", state.speed);
  return "none: unstable at low speed too";
}

std::string critical_answer(const CriticalAdvice &advice, const CriticalQuestion &q)
{
  const std::string now = fmt::format("The critical speed is {}, the working speed {:.4g} m/s. ",
                                      speed_words(advice.now), q.working_speed);
  if (advice.reached)
    return now + fmt::format("The wanted margin of {:g} % is there already.", 100 * q.margin);
  if (advice.actions.empty() || !advice.actions.front().against.empty())
    return now + "No action that was tried raises it and keeps the limits.";
  const RatedAction &best = advice.actions.front();
  return now +
         fmt::format("Best: {}, {} ({:+.2f} %, first order {:+.2f} %), which {} the wanted margin of {:g} %.",
                     best.name, speed_words(advice.states.front()), 100 * best.change, 100 * best.first_order,
                     advice.reaches.front() ? "reaches" : "does not reach", 100 * q.margin);
}

// Growth over speed as it is, and of the best actions, at the speeds that the search of the first tried.
Table growth_table(const CriticalAdvice &advice)
{
  std::vector<double> speeds;
  for (const dynamics::SpeedPoint &point : advice.now.found.points)
    if (std::isfinite(point.growth))
      speeds.push_back(point.speed);
  const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd>(speeds.data(), Eigen::Index(speeds.size()));
  const auto growth       = [&](const dynamics::CriticalSpeed &found) {
    Eigen::VectorXd g(v.size());
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      g[i]                               = not_given;
      const dynamics::SpeedPoint *before = nullptr;
      for (const dynamics::SpeedPoint &point : found.points) {
        if (point.speed == v[i])
          g[i] = point.growth;
        else if (before && before->speed < v[i] && v[i] < point.speed)
          g[i] = before->growth +
                 (point.growth - before->growth) * (v[i] - before->speed) / (point.speed - before->speed);
        before = &point;
      }
    }
    return g;
  };
  Table table;
  table.add("speed", "m/s", v).add("as it is", "1/s", growth(advice.now.found));
  for (std::size_t i = 0, drawn = 0; i < advice.actions.size() && drawn < 2; ++i)
    if (advice.actions[i].against.empty() && (drawn == 0 || !advice.actions[i].pair)) {
      table.add(advice.actions[i].name, "1/s", growth(advice.states[i].found));
      ++drawn;
    }
  return table;
}

Parameter speed_of(const twin::CriticalState &state, const std::string &method, const double at,
                   const double spread = not_given)
{
  Parameter p;
  p.value          = state.found.verdict == dynamics::Verdict::crossing ? state.speed : not_given;
  p.unit           = "m/s";
  p.method         = method;
  p.at             = {"working speed {}", {{at, "m/s", ".4g"}}};
  p.error_estimate = spread;
  if (std::isnan(spread))
    p.error_lacks = {"errors of stand, friction law and flow stress"};
  return p;
}
}  // namespace

std::string no_torque_limit()
{
  return "advice.torque_rise is not given: the torque is shown and limits nothing";
}

twin::AdviceRecord critical_speed_advice(const Case &the_case, const int threads)
{
  const auto &spec            = std::get<ChatterCase>(the_case.spec);
  const std::size_t condition = asked_condition(spec);
  const RollingCondition &own = spec.conditions[condition];
  CriticalQuestion question   = question_of(spec, condition);
  question.threads            = threads;
  const CriticalAdvice advice = twin::critical_advice(question);
  twin::AdviceRecord record;
  record.case_name = the_case.name;
  record.stand     = chatter_question(spec, condition).structure;
  record.goal      = "critical speed";
  record.question =
      fmt::format("critical speed of condition {} at least {:g} % above the working speed of {:.4g} m/s, "
                  "exit thickness {:.4g} mm kept",
                  own.name, 100 * question.margin, question.working_speed, 1e3 * own.exit_thickness);
  record.answer    = critical_answer(advice, question);
  const auto input = [&](const char *key) { return fmt::format("condition.{}.{}", condition, key); };
  Parameter now    = speed_of(advice.now, "search over the speed", question.working_speed, advice.spread);
  now.inputs       = {input("entry_thickness"), input("exit_thickness"), input("entry_tension"),
                      input("exit_tension"),    input("width"),          "analysis.speeds"};
  record.results.add("advice.critical_speed", now);
  if (!advice.actions.empty() && advice.actions.front().against.empty()) {
    record.results.add("advice.best.critical_speed",
                       speed_of(advice.states.front(), advice.actions.front().name, question.working_speed));
    Parameter change = speed_of(advice.states.front(), advice.actions.front().name, question.working_speed);
    change.value     = advice.actions.front().change;
    change.unit      = "1";
    if (const double sd = advice.actions.front().spread; std::isfinite(sd)) {
      change.error_estimate = std::abs(sd / change.value);
      change.error_lacks.clear();
    }
    change.checks.push_back({"first order, by exact slopes", advice.actions.front().first_order,
                             "not the answer: second order is left out"});
    record.results.add("advice.best.change", change);
  }
  for (const ChatterSensitivity &slope : advice.slopes.inputs)
    record.slopes.emplace_back(slope.key, slope.critical_speed);
  if (advice.now.found.verdict != dynamics::Verdict::crossing)
    record.notes.push_back("no critical speed was found in the range searched (" +
                           sentence(advice.now.found, question.range) +
                           "): slopes and first order are left out, and changes count from the end of the range");
  if (std::isnan(spec.advice.torque_rise))
    record.notes.push_back(no_torque_limit());
  record.notes.push_back("what the stand before or behind does with another thickness or tension is not computed");
  record.tables["growth"] = growth_table(advice);
  record.actions          = advice.actions;
  record.reaches          = advice.reaches;
  return record;
}
}  // namespace mill
