#include "app/stages/bite_study.h"
#include "app/stages/bite_roll_stage.h"
#include "app/stages/strip_flow_stage.h"
#include "bite/slab/flattening.h"
#include "core/case/errors.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bite::Arc;
using bite::Theory;

// A model that refuses is an answer as well: the others stand, and the report says why.
BiteAnswer ask(const BiteStudy &study, const std::string &key, const bite::SlabModel &model)
{
  BiteAnswer answer;
  answer.key        = key;
  const auto &bite  = study.question.bite;
  const bool shaped = model.arc == Arc::elastic && study.flexibility.position.size() > 0;
  try {
    answer.state     = bite::solve_slab(bite, model, shaped ? &study.flexibility : nullptr);
    answer.stiffness = bite::slab_stiffness(bite, answer.state);
  } catch (const InputError &e) {
    answer.refused = e.problems.front().message;
  } catch (const SolverError &e) {
    answer.refused = e.what();
  }
  return answer;
}

// What stands beside the chosen theory: the others that know this friction, the rigid roll and the free arc.
std::vector<std::pair<std::string, bite::SlabModel>> models_beside(const BiteQuestion &q)
{
  const bool factors = !slides(q.bite.strip.friction);
  const Arc arc      = q.setup.arc == "rigid" ? Arc::rigid : Arc::hitchcock;
  std::vector<std::pair<std::string, bite::SlabModel>> models{
      {"karman-rigid", {Theory::karman, Arc::rigid}},
      {"karman",       {Theory::karman, arc}       },
      {"orowan",       {Theory::orowan, arc}       }
  };
  if (factors)
    models.push_back({
        "hu-ehmann", {Theory::hu_ehmann, arc}
    });
  else
    models.push_back({
        "bland-ford", {Theory::bland_ford, arc}
    });
  if (factors || plain_coefficient(q.bite.strip.friction) >= 0.25)  // it takes the strip as sticking
    models.push_back({
        "sims", {Theory::sims, arc}
    });
  if (q.setup.arc == "elastic" || (q.setup.arc == "hitchcock" && q.curves))
    models.push_back({
        "karman-elastic-arc", {Theory::karman, Arc::elastic}
    });
  return models;
}

std::string key_of(const BiteSetup &setup)
{
  return setup.arc == "elastic" ? "karman-elastic-arc" : setup.theory;
}

void add_finite_elements(RunContext &run, BiteStudy &study)
{
  BiteAnswer answer;
  answer.key = "fe";
  const FlowQuestion q{study.question.bite, study.question.setup, study.question.pass};
  const bool shaped = study.question.setup.arc == "elastic";
  if (shaped && study.question.setup.strip == "rigid-plastic")
    run.assume(
        "bite of " + q.pass +
        ": a rigid-plastic strip ends with a step of pressure, under which a free arc has no "
        "limit; its finite elements run on Hitchcock's circle, bite.strip = \"elastic-plastic\" on the free arc");
  try {
    study.flow       = solve_flow(run, q, shaped ? &study.flexibility : nullptr);
    answer.state     = study.flow->fine.state;
    answer.stiffness = bite::slab_stiffness(q.bite, answer.state);
  } catch (const SolverError &e) {
    answer.refused = e.what();
    study.failure  = std::current_exception();
  }
  study.answers.push_back(std::move(answer));
}
}  // namespace

const BiteAnswer *BiteStudy::find(const std::string &key) const
{
  for (const BiteAnswer &answer : answers)
    if (answer.key == key && answer.refused.empty())
      return &answer;
  return nullptr;
}

const BiteAnswer &BiteStudy::slab() const
{
  return answers.front();
}

const BiteAnswer &BiteStudy::chosen() const
{
  const BiteAnswer *fe = question.setup.method == "fe" ? find("fe") : nullptr;
  return fe ? *fe : slab();
}

bool BiteStudy::beyond_circle() const
{
  const BiteAnswer &answer = chosen();
  const bool circle        = question.setup.arc == "hitchcock" ||
                      (question.setup.arc == "elastic" && answer.key == "fe" && !flow->elastic);
  return circle && bite::beyond_hitchcock(question.bite, answer.state.flattened_radius);
}

namespace {
// What the accuracy of the chosen answer asks for beside the models that stand there anyway.
void add_for_accuracy(BiteStudy &study)
{
  const bite::SlabModel free{Theory::karman, Arc::elastic};
  if (study.beyond_circle() && !study.find("karman-elastic-arc"))  // on a half plane: no section was made
    study.answers.insert(study.answers.begin() + 1, ask(study, "karman-elastic-arc", free));
  if (study.slab().key != "karman-elastic-arc" || !study.slab().refused.empty() || study.flexibility_error == 0)
    return;
  BiteStudy softer;
  softer.question    = study.question;
  softer.flexibility = study.flexibility;
  softer.flexibility.influence *= 1 + study.flexibility_error;
  BiteAnswer answer = ask(softer, "karman-elastic-arc", free);
  if (answer.refused.empty())
    study.softer = std::move(answer);
}
}  // namespace

BiteStudy study_bite(RunContext &run, const BiteQuestion &question)
{
  BiteStudy study;
  study.question = question;
  // A circle needs no section of the roll; with the curves it is shown all the same what the free arc would do.
  if (question.setup.arc == "elastic" || (question.setup.arc == "hitchcock" && question.curves)) {
    auto roll               = roll_flexibility(run, question);
    study.flexibility       = std::move(roll.flexibility);
    study.flexibility_error = mesh_pair_safety * roll.error_estimate;
  }
  {
    StageTimer timer(run, "bite, slab theories, " + question.pass);
    const std::string chosen = key_of(question.setup);
    const auto model         = slab_model(question.setup);
    BiteAnswer first         = ask(study, chosen, model);
    if (!first.refused.empty() && question.setup.method == "slab")
      bite::solve_slab(question.bite, model,
                       model.arc == Arc::elastic ? &study.flexibility : nullptr);  // throws what it said
    study.answers.push_back(std::move(first));
    for (const auto &[key, other] : models_beside(question))
      if (key != chosen)
        study.answers.push_back(ask(study, key, other));
  }
  if (question.setup.method == "fe")
    add_finite_elements(run, study);
  add_for_accuracy(study);
  return study;
}

bite::SlabModel slab_model(const BiteSetup &setup)
{
  const std::string &name = setup.theory;
  const Theory theory     = name == "bland-ford"  ? Theory::bland_ford
                            : name == "hu-ehmann" ? Theory::hu_ehmann
                            : name == "orowan"    ? Theory::orowan
                            : name == "sims"      ? Theory::sims
                                                  : Theory::karman;
  return {theory, setup.arc == "rigid" ? Arc::rigid : setup.arc == "elastic" ? Arc::elastic : Arc::hitchcock};
}

std::string model_text(const BiteAnswer &answer)
{
  return answer.refused.empty() ? answer.state.model : answer.key;
}
}  // namespace mill
