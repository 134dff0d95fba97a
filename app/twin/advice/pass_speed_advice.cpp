#include "app/twin/advice/pass_speed_advice.h"
#include "app/stages/bite/free_strip.h"
#include "app/twin/advice/asked_choices.h"
#include "app/twin/advice/speed_record.h"
#include "core/model/case.h"
#include "core/records/stand_place.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <mutex>
#include <utility>

namespace mill {
namespace {
using twin::CriticalQuestion;
using twin::DamperChoice;
using twin::StructureAction;

constexpr double usual_what_if = 1.5;  // factor on the damping ratios

std::string missing_for_speed(const Case &the_case, const FourHigh &stand)
{
  std::string missing = missing_of_bite(the_case);
  if (std::isnan(stand.passes.front().speed))
    missing += (missing.empty() ? "" : ", ") + std::string("pass.0.speed");
  return missing;
}

twin::Attachment on_chocks(twin::Attachment damper, const twin::VibratingStand &stand)
{
  for (int *end : {&damper.from, &damper.to})
    if (*end >= 0)
      if (const int chock = on_its_chock(stand, stand.places[std::size_t(*end)]); chock >= 0)
        *end = chock;
  return damper;
}

std::string chock_text(const twin::VibratingStand &stand, const DamperChoice &choice)
{
  const auto place = [&](const int i) { return i < 0 ? std::string(ground_place) : stand.places[std::size_t(i)]; };
  std::string text;
  for (const twin::Attachment &damper : choice.joined)
    text += (text.empty() ? "between " : "; ") + place(damper.from) + " and " + place(damper.to);
  return text;
}

// Dampers where they can be mounted: on the chocks, and between the chocks of the work rolls and the housing.
std::vector<DamperChoice> mounted_dampers(const twin::VibratingStand &stand, const StandAdvice &asked,
                                          const Case &the_case)
{
  std::vector<DamperChoice> choices = damper_choices(stand, asked, the_case);
  for (DamperChoice &choice : choices)
    for (twin::Attachment &damper : choice.joined)
      damper = on_chocks(damper, stand);
  if (!asked.dampers.empty() || !(asked.usual_damper > 0))
    return choices;
  DamperChoice to_housing{
      fmt::format("dampers {:g} kN s/m, both work-roll chocks to the housing", asked.usual_damper / 1e3), {}};
  for (const char *chock : {"upper work-roll chock", "lower work-roll chock"})
    if (const int place = stand.place(chock); place >= 0) {
      twin::Attachment damper;
      damper.to     = place;
      damper.damper = asked.usual_damper;
      to_housing.joined.push_back(damper);
    }
  if (to_housing.joined.size() == 2)
    choices.push_back(std::move(to_housing));
  return choices;
}

// The stand without its bite and what may be done to it.
class ActedStand {
public:
  ActedStand(const Case &the_case, const StandAdvice &asked, AdvisedModel model) : model_(std::move(model))
  {
    own_     = *open({});
    dampers_ = mounted_dampers(own_, asked, the_case);
    for (const char *spring : {"K1", "K3", "K5", "K7"})
      if (asked.springs.empty() || std::count(asked.springs.begin(), asked.springs.end(), spring) > 0)
        for (const double factor : asked.stiffness)
          if (factor != 1)
            actions.push_back(
                {fmt::format("{} x {:g}", spring, factor), spring, twin::means_of_spring(spring), spring, factor});
    for (std::size_t i = 0; i < dampers_.size(); ++i)
      actions.push_back({dampers_[i].name, dampers_[i].name, chock_text(own_, dampers_[i]),
                         damper_key + std::to_string(i), 1, twin::ChangeOf::new_damper});
  }
  std::vector<StructureAction> actions;

  twin::NumberedStructure changed(const twin::StructureChanges &changes) const
  {
    twin::StandChange change;
    std::vector<twin::Attachment> joined;
    for (const auto &[key, factor, what] : changes)
      switch (what) {
      case twin::ChangeOf::rolling_force:
        change.force *= factor;
        break;
      case twin::ChangeOf::damping_ratio:
        change.damping *= factor;
        break;
      case twin::ChangeOf::new_damper:
        for (const twin::Attachment &damper : dampers_[std::stoul(key.substr(damper_key.size()))].joined)
          joined.push_back(damper);
        break;
      case twin::ChangeOf::spring:
      case twin::ChangeOf::damper:
        change.springs.emplace_back(key, factor);
        break;
      }
    return numbered(*open(change), joined);
  }

private:
  inline static const std::string damper_key = "damper.";
  AdvisedModel model_;
  twin::VibratingStand own_;
  std::vector<DamperChoice> dampers_;
  mutable std::mutex closed_forms_;  // one at a time

  std::optional<twin::VibratingStand> open(const twin::StandChange &change) const
  {
    const std::lock_guard alone(closed_forms_);
    return model_.detailed ? model_.detailed->after(change, false) : model_.advised.open(change);
  }

  static twin::NumberedStructure numbered(const twin::VibratingStand &open,
                                          const std::vector<twin::Attachment> &joined)
  {
    twin::NumberedStructure all{twin::joined_structure(open, joined), {}};
    dynamics::StructureNumber damping;
    damping.kind  = dynamics::NumberKind::damping_ratio;
    damping.key   = "dynamics.modal_damping";
    damping.name  = "damping ratio of all modes";
    damping.unit  = "1";
    damping.value = open.damping.maxCoeff();
    damping.C_by  = twin::joined_structure(open, {}).C;
    if (damping.C_by.rows() == all.structure.n() && damping.value > 0)
      all.numbers.push_back(std::move(damping));
    return all;
  }
};

CriticalQuestion question_of(const twin::RolledPass &pass, const RolledAdvice &rolled, const ActedStand &stand)
{
  CriticalQuestion q;
  static_cast<twin::ChatterModel &>(q) = pass.model;
  twin::NumberedStructure unchanged    = stand.changed({});
  q.stand.structure                    = std::move(unchanged.structure);
  q.numbers                            = std::move(unchanged.numbers);
  q.actions                            = stand.actions;
  q.follows_force                      = true;
  q.changed       = [&stand](const twin::StructureChanges &changes) { return stand.changed(changes); };
  q.working_speed = std::fmax(pass.working_speed, rolled.wanted_speed);
  q.margin        = rolled.margin;
  q.process       = rolled;
  return q;
}
}  // namespace

bool asks_critical_speed(const Case &the_case, const RolledAdvice &rolled, const std::string &measured)
{
  const auto *stand = std::get_if<FourHigh>(&the_case.spec);
  if (!stand || rolled.goal == AdviceGoal::level)
    return false;
  const std::string missing = missing_for_speed(the_case, *stand);
  if (!rolled.goal)
    return missing.empty() && measured.empty() && !the_case.places.count("advice.place") &&
           !the_case.places.count("advice.band");
  if (!missing.empty())
    throw InputError(place_of_key(the_case, "advice.goal"),
                     "advice.goal = \"critical-speed\" needs " + missing + "; give what is missing");
  if (!measured.empty())
    throw InputError(place_of_key(the_case, "advice.goal"),
                     "advice.goal = \"critical-speed\": a critical speed does not follow from a measured force; "
                     "leave --measured out, or take advice.goal = \"level\"");
  return true;
}

twin::AdviceRecord pass_speed_advice(const Case &the_case, const RolledAdvice &rolled,
                                     const Components &components, const int threads)
{
  const auto &four            = std::get<FourHigh>(the_case.spec);
  StandAdvice asked           = four.advice;
  AdvisedModel model          = advised_model(the_case, asked, rolled, components);
  const twin::RolledPass pass = *model.pass;
  twin::AdviceRecord record;
  record.case_name = the_case.name;
  record.goal      = RatedGoal::critical_speed;
  record.stand = model.detailed ? "rolls as " + model.detailed->name + ", springs by closed forms" : model.source;
  for (const Note &note : model.notes)
    if (!note.is(NoteId::springs_not_tried))
      record.notes.push_back(note);
  const ActedStand stand(the_case, asked, std::move(model));
  CriticalQuestion question = question_of(pass, rolled, stand);
  question.threads          = threads;
  question.damping          = the_case.places.count("advice.modal_damping") > 0 ? asked.modal_damping
                                                                                : std::array<double, 2>{1, usual_what_if};
  const bool raised         = question.working_speed > pass.working_speed;
  record.question =
      fmt::format("critical speed of {} at least {:g} % above the {} speed of {:.4g} m/s{}, exit "
                  "thickness {:.4g} mm kept",
                  four.passes.front().name, 100 * question.margin, raised ? "wanted" : "working",
                  question.working_speed, raised ? fmt::format(" (now {:.4g} m/s)", pass.working_speed) : "",
                  1e3 * pass.model.bite.strip.exit_thickness);
  const twin::CriticalAdvice advice = twin::critical_advice(question);
  fill_speed_record(record, advice, question,
                    {"pass.0.speed", "strip.entry_thickness", "strip.exit_thickness", "strip.friction",
                     "strip.flow_stress", "dynamics.modal_damping", "analysis.speeds", "advice.wanted_speed"});
  record.notes.push_back(
      "standard deviations hold pass, bite and damping; springs of the stand are compared as they "
      "are. K2 and K6 are several parts of the drawing and are not tried");
  record.notes.push_back("contacts follow the rolling force of an action on the pass; dampers sit on the chocks");
  return record;
}
}  // namespace mill
