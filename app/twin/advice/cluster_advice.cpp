#include "app/twin/advice/cluster_advice.h"
#include "app/cluster/cluster_chatter.h"
#include "app/twin/advice/asked_choices.h"
#include "app/twin/advice/speed_record.h"
#include "app/twin/stand/chatter_model.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using twin::CriticalQuestion;

// The stack of a pass with its bite.
struct Asked {
  std::size_t pass = 0;
  ClusterChatter chatter;
};

// The pass that is named, or the first that says enough for a search.
Asked asked_pass(const Case &the_case, const ClusterStand &stand)
{
  std::optional<InputError> refused;
  for (std::size_t p = 0; p < stand.schedule.size(); ++p) {
    const ClusterPass &pass = stand.schedule[p];
    if (!stand.advice.condition.empty() && stand.advice.condition != pass.name)
      continue;
    try {
      const ClusterForce force = cluster_force(stand, pass);
      return {p, chatter_question(the_case, stand, p, force, cluster::pass_state(stand, pass, force.value))};
    } catch (const InputError &e) {
      if (!refused)
        refused = e;
    }
  }
  throw *refused;
}

// The stand with several of its numbers changed at once.
twin::NumberedStructure changed_stand(const ClusterStand &stand, const ClusterChatter &chatter,
                                      const twin::StructureChanges &changes)
{
  cluster::GapStand gap = chatter.gap;
  double damping        = 1;
  for (const twin::StructureChange &change : changes)
    if (change.what == twin::ChangeOf::damping_ratio)
      damping *= change.factor;
    else
      for (const StiffnessGroup &group : stiffness_groups(stand))
        if (group.key == change.key)
          gap = cluster::scaled(std::move(gap), group.contacts, group.supports, change.factor);
  twin::NumberedStructure all{structure_of(stand, chatter.stack, gap), cluster_numbers(stand, chatter.stack, gap)};
  all.structure.C *= damping;
  for (dynamics::StructureNumber &number : all.numbers)
    if (number.kind == dynamics::NumberKind::damping_ratio) {
      number.value *= damping;
      number.C_by *= damping;
    }
  return all;
}

CriticalQuestion question_of(const ClusterStand &stand, const ClusterChatter &chatter)
{
  CriticalQuestion q;
  static_cast<twin::ChatterModel &>(q) = chatter_model(chatter.question);
  q.working_speed                      = std::fmax(chatter.question.condition.speed, stand.advice.wanted_speed);
  q.margin                             = stand.advice.margin;
  q.process                            = process_of(stand.advice);
  q.stiffness                          = stand.advice.stiffness;
  q.damping                            = stand.advice.damping;
  for (const char *springs : {"contact.", "support."})
    q.doubts.push_back({springs, 0.05, false});
  q.doubts.push_back({"response.loss_factor", 0.3, false});
  q.changed = [&stand, &chatter](const twin::StructureChanges &changes) {
    return changed_stand(stand, chatter, changes);
  };
  return q;
}
}  // namespace

twin::AdviceRecord cluster_advice(const Case &the_case, const int threads)
{
  const ClusterStand &stand         = *std::get<ClusterCase>(the_case.spec).stand;
  const Asked asked                 = asked_pass(the_case, stand);
  const RollingCondition &condition = asked.chatter.question.condition;
  CriticalQuestion question         = question_of(stand, asked.chatter);
  question.threads                  = threads;
  const twin::CriticalAdvice advice = twin::critical_advice(question);
  twin::AdviceRecord record;
  record.case_name = the_case.name;
  record.stand     = asked.chatter.question.structure;
  record.goal      = RatedGoal::critical_speed;
  record.question = fmt::format("critical speed of pass {} at least {:g} % above the {} speed of {:.4g} m/s, exit "
                                "thickness {:.4g} mm kept",
                                condition.name, 100 * question.margin,
                                question.working_speed > condition.speed ? "wanted" : "working",
                                question.working_speed, 1e3 * condition.exit_thickness);
  for (const std::string &assumed : asked.chatter.assumed)
    record.notes.emplace_back(NoteId::assumed, "", assumed);
  fill_speed_record(record, advice, question, asked.chatter.question.inputs);
  return record;
}
}  // namespace mill
