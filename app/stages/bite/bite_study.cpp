#include "app/stages/bite/bite_study.h"
#include "app/stages/bite/bite_roll_stage.h"
#include "app/stages/bite/strip_flow_stage.h"
#include "core/base/errors.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/bite_model.h"
#include "core/records/result_names.h"
#include "reduce/bite/slab/flattening.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bite::Arc;

// The section of the roll, where a model of the study needs one.
void add_section(RunContext &run, BiteStudy &study)
{
  if (study.flexibility.position.size() > 0)
    return;
  try {
    require_section(study.question);
  } catch (const InputError &e) {  // an arc too long for a section: the models take a half plane instead
    run.assume("bite of " + study.question.pass +
               ": the roll's surface is that of a half plane: " + e.problems.front().message);
    return;
  }
  auto roll               = roll_flexibility(run, study.question);
  study.flexibility       = std::move(roll.flexibility);
  study.flexibility_error = mesh_pair_safety * roll.error_estimate;
}

// The finite elements of one setting; what they say is kept where they find no answer.
std::optional<FlowAnswer> try_flow(RunContext &run, BiteStudy &study, const BiteSetup &setup)
{
  const FlowQuestion q{study.question.bite, setup, study.question.pass};
  const bool shaped = setup.arc == BiteArc::elastic;
  if (shaped && setup.strip == BiteStrip::rigid_plastic)
    run.assume(
        "bite of " + q.pass +
        ": a rigid-plastic strip ends with a step of pressure, under which a free arc has no "
        "limit; its finite elements run on Hitchcock's circle, bite.strip = \"elastic-plastic\" on the free arc");
  if (shaped)
    add_section(run, study);
  try {
    return solve_flow(run, q, shaped && study.flexibility.position.size() > 0 ? &study.flexibility : nullptr);
  } catch (const SolverError &e) {
    study.failures.push_back(fmt::format("{} strip: {}", word_of(setup.strip), e.report.what));
  } catch (const SystemError &) {  // a full disk says nothing about the strip
    throw;
  } catch (const InputError &e) {
    study.failures.push_back(fmt::format("{} strip: {}", word_of(setup.strip), e.problems.front().message));
  }
  return std::nullopt;
}

// @param asked  the settings of the case
void add_finite_elements(RunContext &run, BiteStudy &study, const BiteSetup &asked)
{
  BiteAnswer answer;
  answer.key = "fe";
  study.flow = try_flow(run, study, study.question.setup);
  if (!study.flow) {
    const BiteSetup other = fem::other_strip(study.question.setup, asked);
    study.flow            = try_flow(run, study, other);
    if (study.flow)
      study.question.setup = other;
  }
  if (study.flow) {
    answer.state     = study.flow->fine.state;
    answer.stiffness = bite::slab_stiffness(study.question.bite, answer.state);
  } else {
    answer.refused = study.failures.front();
  }
  study.answers.push_back(std::move(answer));
}

// Where every slab theory says that no roll can take the strip finite elements are not asked.
void refuse_impossible(const BiteStudy &study)
{
  const auto impossible = [](const BiteAnswer &answer) { return answer.impossible; };
  if (std::all_of(study.answers.begin(), study.answers.end(), impossible))
    throw InputError("bite of " + study.question.pass + ": " + study.slab().refused);
}

}  // namespace

BiteStudy study_bite(RunContext &run, const BiteQuestion &question)
{
  BiteStudy study;
  study.regime           = bite::regime_of(question.bite);
  study.question         = question;
  study.question.setup   = fem::settled_setup(question.setup, study.regime);
  const BiteSetup &setup = study.question.setup;
  // A circle needs no section of the roll; with the curves it is shown all the same what the free arc would do.
  if (setup.arc == BiteArc::elastic || (setup.arc == BiteArc::hitchcock && question.curves))
    add_section(run, study);
  {
    StageTimer timer(run, "bite, slab theories, " + question.pass);
    const std::string chosen = fem::slab_key(setup);
    const auto model         = fem::slab_model(setup);
    BiteAnswer first         = fem::slab_answer(study, chosen, model);
    if (!first.refused.empty() && setup.method == BiteMethod::slab)
      bite::solve_slab(question.bite, model,
                       model.arc == Arc::elastic ? &study.flexibility : nullptr);  // throws the same error again
    study.answers.push_back(std::move(first));
    for (const auto &[key, other] : fem::compared_theories(study.question))
      if (key != chosen)
        study.answers.push_back(fem::slab_answer(study, key, other));
  }
  refuse_impossible(study);
  if (setup.method == BiteMethod::fe)
    add_finite_elements(run, study, question.setup);
  study.chosen();  // or no theory has an answer
  fem::add_for_accuracy(study);
  return study;
}

std::optional<Warning> bite_without_theory(const BiteQuestion &question)
{
  BiteStudy study;
  study.question = question;
  study.regime   = bite::regime_of(question.bite);
  if (!std::isnan(study.regime.flattening))
    return {};
  for (const auto &[key, model] : fem::compared_theories(question))
    if (key != word_of(BiteModel::karman_rigid) && key != word_of(BiteModel::sims) &&
        fem::slab_answer(study, key, model).refused.empty())
      return {};
  Warning warning = fem::no_arc_carries(question.pass, study.regime);
  warning.detail += "; a run ends with this unless its finite elements have an answer";
  return warning;
}

std::string model_text(const BiteAnswer &answer)
{
  return answer.refused.empty() ? answer.state.model : answer.key;
}
}  // namespace mill
