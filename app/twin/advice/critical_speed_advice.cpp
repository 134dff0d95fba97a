#include "app/twin/advice/critical_speed_advice.h"
#include "app/chatter/chatter_question.h"
#include "app/twin/advice/asked_choices.h"
#include "app/twin/advice/speed_record.h"
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

// Numbers of the stand by the keys of dynamics::StructureNumber: "stand.masses[2]", "K3".
void scale(ChatterCase &spec, const twin::StructureChange &change)
{
  const auto &[key, factor, what] = change;
  if (what == twin::ChangeOf::damping_ratio) {
    spec.modal_damping *= factor;
    return;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string stiffness = fmt::format("stand.stiffnesses[{}]", i),
                      damping   = fmt::format("stand.dampings[{}]", i);
    if (key == stiffness) {
      spec.stand.stiffnesses[i] *= factor;
      if (spec.model)
        spec.model->K[i < 3 ? i : i + 1].value *= factor;  // K4 is the bite's
    } else if (key == damping)
      spec.stand.dampings[i] *= factor;
  }
  if (spec.model)
    for (std::size_t j = 0; j < spec.model->K.size(); ++j)
      if (key == fmt::format("K{}", j + 1))
        spec.model->K[j].value *= factor;
}

// Of the six springs of a chatter stand the one that is spring j of a lumped model; K4 is the bite's.
std::string spring_key(const std::size_t j)
{
  return j == 3 ? "" : fmt::format("stand.stiffnesses[{}]", j < 3 ? j : j - 1);
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
    for (const twin::StructureChange &change : changes)
      scale(changed, change);
    ChatterQuestion after = chatter_question(changed, condition);
    return twin::NumberedStructure{std::move(after.stand.structure), std::move(after.numbers)};
  };
  return q;
}

}  // namespace

twin::AdviceRecord critical_speed_advice(const Case &the_case, const int threads)
{
  const auto &spec               = std::get<ChatterCase>(the_case.spec);
  const std::size_t condition    = asked_condition(spec);
  const RollingCondition &rolled = spec.conditions[condition];
  CriticalQuestion question      = question_of(spec, condition);
  question.threads               = threads;
  question.working_speed         = std::fmax(rolled.speed, spec.advice.wanted_speed);
  const CriticalAdvice advice    = twin::critical_advice(question);
  twin::AdviceRecord record;
  record.case_name = the_case.name;
  record.stand     = chatter_question(spec, condition).structure;
  record.goal      = RatedGoal::critical_speed;
  record.question =
      fmt::format("critical speed of condition {} at least {:g} % above the {} speed of {:.4g} m/s, "
                  "exit thickness {:.4g} mm kept",
                  rolled.name, 100 * question.margin, question.working_speed > rolled.speed ? "wanted" : "working",
                  question.working_speed, 1e3 * rolled.exit_thickness);
  const auto input = [&](const char *key) { return fmt::format("condition.{}.{}", condition, key); };
  fill_speed_record(record, advice, question,
                    {input("entry_thickness"), input("exit_thickness"), input("entry_tension"),
                     input("exit_tension"), input("width"), "analysis.speeds"});
  return record;
}
}  // namespace mill
