#include "app/twin/advice/speed_record.h"
#include "app/chatter/chatter_question.h"
#include "core/records/rows_of_response.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using twin::CriticalAdvice;
using twin::CriticalQuestion;
using twin::RatedAction;

std::string speed_words(const twin::CriticalState &state)
{
  using dynamics::Verdict;
  if (state.at_least)
    return fmt::format("none up to {:.4g} m/s", state.speed);
  if (state.search.verdict == Verdict::crossing)
    return fmt::format("{:.3f} m/s", state.speed);
  return "none: unstable at low speed too";
}

std::string critical_answer(const CriticalAdvice &advice, const CriticalQuestion &q)
{
  const std::string now =
      fmt::format("The critical speed is {}, the {} speed {:.4g} m/s. ", speed_words(advice.now),
                  q.working_speed == q.process.wanted_speed ? "wanted" : "working", q.working_speed);
  if (advice.reached)
    return now + fmt::format("The wanted margin of {:g} % is there already.", 100 * q.margin);
  if (advice.actions.empty() || !advice.actions.front().against.empty())
    return now + "No action that was tried raises it and keeps the limits.";
  const RatedAction &best = advice.actions.front();
  const std::string first_order =
      std::isfinite(best.first_order) ? fmt::format(", first order {:+.2f} %", 100 * best.first_order) : "";
  return now + fmt::format("Best: {}, {} ({:+.2f} %{}), which {} the wanted margin of {:g} %.", best.name,
                           speed_words(advice.states.front()), 100 * best.change, first_order,
                           advice.reaches.front() ? "reaches" : "does not reach", 100 * q.margin);
}

// Growth over speed as it is, and of the best actions, at the speeds that the search of the first tried.
Table growth_table(const CriticalAdvice &advice)
{
  std::vector<double> speeds;
  for (const dynamics::SpeedPoint &point : advice.now.search.points)
    if (std::isfinite(point.growth))
      speeds.push_back(point.speed);
  const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd>(speeds.data(), Eigen::Index(speeds.size()));
  const auto growth       = [&](const dynamics::CriticalSpeed &search) {
    Eigen::VectorXd g(v.size());
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      g[i]                               = not_given;
      const dynamics::SpeedPoint *before = nullptr;
      for (const dynamics::SpeedPoint &point : search.points) {
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
  table.add("speed", "m/s", v).add("as it is", "1/s", growth(advice.now.search));
  for (std::size_t i = 0, drawn = 0; i < advice.actions.size() && drawn < 2; ++i)
    if (advice.actions[i].against.empty() && (drawn == 0 || !advice.actions[i].pair)) {
      table.add(advice.actions[i].name, "1/s", growth(advice.states[i].search));
      ++drawn;
    }
  return table;
}

Parameter speed_of(const twin::CriticalState &state, const std::string &method, const double working_speed,
                   const double spread = not_given)
{
  Parameter p;
  p.value          = state.search.verdict == dynamics::Verdict::crossing ? state.speed : not_given;
  p.unit           = "m/s";
  p.method         = method;
  p.at             = {"working speed {}", {{working_speed, "m/s", ".4g"}}};
  p.error_estimate = spread;
  if (std::isnan(spread))
    p.error_lacks = {"errors of stand, friction law and flow stress"};
  return p;
}

void add_best(twin::AdviceRecord &record, const CriticalAdvice &advice, const double working_speed)
{
  if (advice.actions.empty() || !advice.actions.front().against.empty())
    return;
  const RatedAction &best = advice.actions.front();
  record.results.add(row::advice::best_critical_speed.of(),
                     speed_of(advice.states.front(), best.name, working_speed));
  Parameter change = speed_of(advice.states.front(), best.name, working_speed);
  change.value     = best.change;
  change.unit      = "1";
  if (const double sd = best.spread; std::isfinite(sd)) {
    change.error_estimate = std::abs(sd / change.value);
    change.error_lacks.clear();
  }
  if (std::isfinite(best.first_order))
    change.checks.push_back(
        {"first order, by exact slopes", best.first_order, "not the answer: second order is left out"});
  record.results.add(row::advice::best_change.of(), change);
}
}  // namespace

Note no_torque_limit()
{
  return {NoteId::torque_not_limited,
          "",
          "advice.torque_rise is not given",
          "the torque is shown and limits nothing",
          "",
          {},
          "advice.torque_rise"};
}

void fill_speed_record(twin::AdviceRecord &record, const CriticalAdvice &advice, const CriticalQuestion &question,
                       const std::vector<std::string> &inputs)
{
  record.answer = critical_answer(advice, question);
  Parameter now = speed_of(advice.now, "search over the speed", question.working_speed, advice.spread);
  now.inputs    = inputs;
  record.results.add(row::advice::critical_speed.of(), now);
  add_best(record, advice, question.working_speed);
  for (const ChatterSensitivity &slope : advice.slopes.inputs)
    record.slopes.emplace_back(slope.key, slope.critical_speed);
  if (advice.now.search.verdict != dynamics::Verdict::crossing)
    record.notes.emplace_back(
        NoteId::no_critical_speed, "",
        "no critical speed was found in the range searched (" + sentence(advice.now.search, question.range) + ")",
        "slopes and first order are left out, and changes are taken from the end of the range");
  if (std::isnan(question.process.torque_rise))
    record.notes.push_back(no_torque_limit());
  record.notes.push_back("what the stand before or behind does with another thickness or tension is not computed");
  record.tables["growth"] = growth_table(advice);
  record.actions          = advice.actions;
  record.reaches          = advice.reaches;
  record.what_ifs         = advice.what_ifs;
}
}  // namespace mill
