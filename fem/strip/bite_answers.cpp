#include "fem/strip/bite_answers.h"
#include "core/base/errors.h"
#include "core/records/bite_model.h"
#include "core/records/result_names.h"
#include "reduce/bite/slab/flattening.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
using bite::Arc;
using bite::Theory;

// The strip that the regime asks for, not the user: on a mesh that ends in seconds too.
void take_elastic_strip(BiteSetup &setup)
{
  setup.strip            = BiteStrip::elastic_plastic;
  setup.elements_along   = 3 * setup.elements_along / 4;
  setup.elements_through = 2 * setup.elements_through / 3;
}

// From the fullest theory to the simplest, where finite elements have no answer.
constexpr const char *fallbacks[] = {"karman-elastic-arc", "karman", "bland-ford", "hu-ehmann", "orowan"};

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

Warning no_arc_carries(const std::string &pass, const bite::Regime &regime)
{
  return {WarningId::bite_model_refused,
          "bite of " + pass,
          "no arc of these rolls carries its own force",
          "they flatten by more than the reduction closes (" + regime.reason + ")",
          "a smaller work roll, less reduction, less friction or more tension is needed",
          {result_name({family::bite, pass})}};
}

BiteAnswer slab_answer(const BiteStudy &study, const std::string &key, const bite::SlabModel &model)
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

std::vector<std::pair<std::string, bite::SlabModel>> compared_theories(const BiteQuestion &q)
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

std::string slab_key(const BiteSetup &setup)
{
  return setup.arc == BiteArc::elastic ? "karman-elastic-arc" : word_of(setup.theory);
}

BiteSetup other_strip(const BiteSetup &settled, const BiteSetup &asked)
{
  const bool was_elastic = settled.strip == BiteStrip::elastic_plastic;
  BiteSetup other        = settled;
  other.elements_along   = asked.elements_along;
  other.elements_through = asked.elements_through;
  if (was_elastic)
    other.strip = BiteStrip::rigid_plastic;
  else
    take_elastic_strip(other);
  if (settled.arc != BiteArc::rigid)
    other.arc = was_elastic ? BiteArc::hitchcock : BiteArc::elastic;
  return other;
}

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

void add_for_accuracy(BiteStudy &study)
{
  const bite::SlabModel free{Theory::karman, Arc::elastic};
  if (study.beyond_circle() && !study.find("karman-elastic-arc"))  // on a half plane: no section was made
    study.answers.insert(study.answers.begin() + 1, slab_answer(study, "karman-elastic-arc", free));
  if (study.slab().key != word_of(BiteModel::karman_elastic_arc) || !study.slab().refused.empty() ||
      study.flexibility_error == 0)
    return;
  BiteStudy softer;
  softer.question    = study.question;
  softer.flexibility = study.flexibility;
  softer.flexibility.influence *= 1 + study.flexibility_error;
  BiteAnswer answer = slab_answer(softer, "karman-elastic-arc", free);
  if (answer.refused.empty())
    study.softer = std::move(answer);
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
    setup.arc = elastic && !other_theory ? BiteArc::elastic : BiteArc::hitchcock;
  return setup;
}

bite::SlabModel slab_model(const BiteSetup &setup)
{
  if (setup.arc == BiteArc::elastic)
    return {Theory::karman, Arc::elastic};
  return {setup.theory, setup.arc == BiteArc::rigid ? Arc::rigid : Arc::hitchcock};
}
}  // namespace mill::fem
