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
    answer.refused    = e.problems.front().message;
    answer.impossible = true;
  } catch (const SolverError &e) {
    answer.refused = e.what();
  }
  return answer;
}

// The theories that the chosen one is compared with: those that accept this friction, the rigid roll and the free
// arc.
std::vector<std::pair<std::string, bite::SlabModel>> models_beside(const BiteQuestion &q)
{
  const bool factors = !slides(q.bite.strip.friction);
  const Arc arc      = q.setup.arc == BiteArc::rigid ? Arc::rigid : Arc::hitchcock;
  std::vector<std::pair<std::string, bite::SlabModel>> models{{"karman-rigid", {Theory::karman, Arc::rigid}},
                                                              {"karman", {Theory::karman, arc}},
                                                              {"orowan", {Theory::orowan, arc}}};
  if (factors)
    models.push_back({"hu-ehmann", {Theory::hu_ehmann, arc}});
  else
    models.push_back({"bland-ford", {Theory::bland_ford, arc}});
  if (factors || plain_coefficient(q.bite.strip.friction) >= 0.25)  // it takes the strip as sticking
    models.push_back({"sims", {Theory::sims, arc}});
  if (q.setup.arc == BiteArc::elastic || (q.setup.arc == BiteArc::hitchcock && q.curves))
    models.push_back({"karman-elastic-arc", {Theory::karman, Arc::elastic}});
  return models;
}

std::string key_of(const BiteSetup &setup)
{
  return setup.arc == BiteArc::elastic ? "karman-elastic-arc" : word_of(setup.theory);
}

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

// The strip that the regime asks for, not the user: on a mesh that ends in seconds too.
void take_elastic_strip(BiteSetup &setup)
{
  setup.strip            = BiteStrip::elastic_plastic;
  setup.elements_along   = 3 * setup.elements_along / 4;
  setup.elements_through = 2 * setup.elements_through / 3;
}

BiteSetup other_strip(BiteSetup setup)
{
  const bool was_elastic = setup.strip == BiteStrip::elastic_plastic;
  if (was_elastic)
    setup.strip = BiteStrip::rigid_plastic;
  else
    take_elastic_strip(setup);
  if (setup.arc != BiteArc::rigid)
    setup.arc = was_elastic ? BiteArc::hitchcock : BiteArc::elastic;
  return setup;
}

void add_finite_elements(RunContext &run, BiteStudy &study)
{
  BiteAnswer answer;
  answer.key = "fe";
  study.flow = try_flow(run, study, study.question.setup);
  if (!study.flow) {
    const BiteSetup other = other_strip(study.question.setup);
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

// From the fullest theory to the simplest, where finite elements have no answer.
constexpr const char *fallbacks[] = {"karman-elastic-arc", "karman", "bland-ford", "hu-ehmann", "orowan"};

// Where every slab theory says that no roll can take the strip finite elements are not asked.
void refuse_impossible(const BiteStudy &study)
{
  const auto impossible = [](const BiteAnswer &answer) { return answer.impossible; };
  if (std::all_of(study.answers.begin(), study.answers.end(), impossible))
    throw InputError("bite of " + study.question.pass + ": " + study.slab().refused);
}

Warning no_arc_carries(const std::string &pass, const bite::Regime &regime)
{
  return {WarningId::bite_model_refused,
          "bite of " + pass,
          "no arc of these rolls carries its own force",
          "they flatten by more than the reduction closes (" + regime.reason + ")",
          "a smaller work roll, less reduction, less friction or more tension is needed",
          {result_name({family::bite, pass})}};
}

// No theory has an answer: what the first one says, and how the finite elements ended.
[[noreturn]] void refuse_pass(const BiteStudy &study)
{
  if (std::isnan(study.regime.flattening))
    throw InputError(text_of(no_arc_carries(study.question.pass, study.regime)));
  std::string tried;
  for (const std::string &failure : study.failures)
    tried += (tried.empty() ? "" : "; ") + failure;
  throw SolverError({"bite of " + study.question.pass + ": no theory has an answer: " + study.slab().refused,
                     study.regime.reason, tried.empty() ? "the pass is none that these rolls can make" : tried,
                     "a smaller work roll, less reduction, less friction, more tension; or K4 in [given]", ""});
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
  const BiteAnswer *fe = question.setup.method == BiteMethod::fe ? find("fe") : nullptr;
  if (fe)
    return *fe;
  if (question.setup.method == BiteMethod::slab)
    return slab();
  for (const char *key : fallbacks)
    if (const BiteAnswer *answer = find(key))
      return *answer;
  refuse_pass(*this);
}

bool BiteStudy::beyond_circle() const
{
  const BiteAnswer &answer = chosen();
  const bool circle =
      question.setup.arc == BiteArc::hitchcock ||
      (question.setup.arc == BiteArc::elastic && answer.key == word_of(BiteModel::fe) && !flow->elastic);
  return circle && bite::beyond_hitchcock(question.bite, answer.state.flattened_radius);
}

namespace {
// What the error estimate of the chosen answer needs in addition to the models that are solved in any case.
void add_for_accuracy(BiteStudy &study)
{
  const bite::SlabModel free{Theory::karman, Arc::elastic};
  if (study.beyond_circle() && !study.find("karman-elastic-arc"))  // on a half plane: no section was made
    study.answers.insert(study.answers.begin() + 1, ask(study, "karman-elastic-arc", free));
  if (study.slab().key != word_of(BiteModel::karman_elastic_arc) || !study.slab().refused.empty() ||
      study.flexibility_error == 0)
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
  study.regime           = bite::regime_of(question.bite);
  study.question         = question;
  study.question.setup   = settled_setup(question.setup, study.regime);
  const BiteSetup &setup = study.question.setup;
  // A circle needs no section of the roll; with the curves it is shown all the same what the free arc would do.
  if (setup.arc == BiteArc::elastic || (setup.arc == BiteArc::hitchcock && question.curves))
    add_section(run, study);
  {
    StageTimer timer(run, "bite, slab theories, " + question.pass);
    const std::string chosen = key_of(setup);
    const auto model         = slab_model(setup);
    BiteAnswer first         = ask(study, chosen, model);
    if (!first.refused.empty() && setup.method == BiteMethod::slab)
      bite::solve_slab(question.bite, model,
                       model.arc == Arc::elastic ? &study.flexibility : nullptr);  // throws the same error again
    study.answers.push_back(std::move(first));
    for (const auto &[key, other] : models_beside(study.question))
      if (key != chosen)
        study.answers.push_back(ask(study, key, other));
  }
  refuse_impossible(study);
  if (setup.method == BiteMethod::fe)
    add_finite_elements(run, study);
  study.chosen();  // or no theory has an answer
  add_for_accuracy(study);
  return study;
}

std::optional<Warning> bite_without_theory(const BiteQuestion &question)
{
  BiteStudy study;
  study.question = question;
  study.regime   = bite::regime_of(question.bite);
  if (!std::isnan(study.regime.flattening))
    return {};
  for (const auto &[key, model] : models_beside(question))
    if (key != word_of(BiteModel::karman_rigid) && key != word_of(BiteModel::sims) &&
        ask(study, key, model).refused.empty())
      return {};
  Warning warning = no_arc_carries(question.pass, study.regime);
  warning.detail += "; a run ends with this unless its finite elements have an answer";
  return warning;
}

BiteSetup settled_setup(BiteSetup setup, const bite::Regime &regime)
{
  const bool circle = setup.arc == BiteArc::hitchcock, rigid_strip = setup.strip == BiteStrip::rigid_plastic;
  const bool other_theory =
      setup.method == BiteMethod::slab && setup.theory != SlabTheory::karman;  // these theories have no free arc
  const bool elastic = setup.strip == BiteStrip::elastic_plastic ||
                       (regime.elastic_strip && !circle && !rigid_strip && !other_theory);
  if (setup.strip == BiteStrip::automatic && elastic)
    take_elastic_strip(setup);
  else if (setup.strip == BiteStrip::automatic)
    setup.strip = BiteStrip::rigid_plastic;
  if (setup.arc == BiteArc::automatic)
    setup.arc = elastic ? BiteArc::elastic : BiteArc::hitchcock;
  return setup;
}

bite::SlabModel slab_model(const BiteSetup &setup)
{
  return {setup.theory, setup.arc == BiteArc::rigid     ? Arc::rigid
                        : setup.arc == BiteArc::elastic ? Arc::elastic
                                                        : Arc::hitchcock};
}

std::string model_text(const BiteAnswer &answer)
{
  return answer.refused.empty() ? answer.state.model : answer.key;
}
}  // namespace mill
