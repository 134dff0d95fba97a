#include "app/twin/stand/case_chain.h"
#include "app/review/closed_form_modes.h"
#include "app/trace/closed_form_chain.h"
#include "core/base/force_text.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "dynamics/chatter/stand_structure.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "twin/records/force_record.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
double load_of_pass(const Pass &pass)
{
  if (!std::isnan(pass.load))
    return pass.load;
  if (!pass.force_file.empty())
    return twin::read_force(pass.force_file).force.mean();
  return (pass.synthetic_range[0] + pass.synthetic_range[1]) / 2;
}

LumpedModel chain_of_results(const std::vector<ClosedFormResult> &results)
{
  LumpedModel model;
  const auto take = [&](const std::string &name, Parameter &into) {
    if (const ClosedFormResult *result = find(results, name))
      into = result->parameter;
  };
  for (std::size_t i = 0; i < model.M.size(); ++i)
    take("M" + std::to_string(i + 1), model.M[i]);
  for (std::size_t i = 0; i < model.K.size(); ++i)
    take("K" + std::to_string(i + 1), model.K[i]);
  take("C", model.C);
  return model;
}
// The stand of a chatter case without its bite.  Its dampers lie between single masses; what a chain in modes
// keeps of them is the mean of the modes' ratios.
CaseChain chain_without_bite(const ChatterCase &spec)
{
  CaseChain chain;
  chain.source                 = "six masses of the stand as given, without the bite";
  chain.dynamics.modal_damping = spec.modal_damping;
  if (spec.model)
    chain.model = *spec.model;
  const ChatterStand &stand        = spec.stand;
  const std::size_t spring_index[] = {0, 1, 2, 4, 5, 6};
  for (std::size_t i = 0; !spec.model && i < 6; ++i) {
    const auto given = [](const double value, const char *unit) {
      Parameter parameter;
      parameter.value  = value;
      parameter.unit   = unit;
      parameter.source = Source::given;
      return parameter;
    };
    chain.model.M[i]               = given(stand.masses[i], "kg");
    chain.model.K[spring_index[i]] = given(stand.stiffnesses[i], "N/m");
  }
  chain.model.K[3].value = 0;
  if (!std::isnan(stand.dampings[0]) && !spec.model) {
    const auto damped = dynamics::six_mass_structure(stand.masses, stand.stiffnesses, stand.dampings);
    const auto modes  = dynamics::modes(dynamics::mill_model(chain.model, chain.dynamics));
    double sum        = 0;
    for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
      const Eigen::VectorXd shape =
          modes.shape.col(i);  // no damper joins the two halves: their signs do not matter
      sum += shape.dot(damped.C * shape) / shape.dot(damped.M * shape) / (4 * M_PI * modes.frequency[i]);
    }
    chain.dynamics.modal_damping = sum / double(modes.frequency.size());
    chain.source += fmt::format(", its dampers as {:.2g} % in every mode", 100 * chain.dynamics.modal_damping);
  }
  return chain;
}
}  // namespace

CaseChain case_chain(const Case &the_case, const std::string &verb, const double load)
{
  CaseChain chain;
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    chain.load     = std::isnan(load) ? load_of_pass(four->passes.front()) : load;
    chain.results  = closed_form_stand(*four, chain.load);
    chain.model    = chain_of_results(chain.results);
    chain.dynamics = four->dynamics;
    chain.source   = "six masses by closed forms at " + force_text(chain.load);
    return chain;
  }
  if (const auto *chatter = std::get_if<ChatterCase>(&the_case.spec); chatter && !chatter->files)
    return chain_without_bite(*chatter);
  const auto *lumped = std::get_if<Lumped>(&the_case.spec);
  if (!lumped || lumped->detailed)
    throw InputError(
        "millstand " + verb + ": the case " + the_case.path +
        " has no chain of six masses; name a case of kind four-high or chatter, or of kind lumped with [given]");
  chain.model    = lumped_model_of(the_case);
  chain.dynamics = lumped->dynamics;
  chain.source   = "six masses as given";
  return chain;
}
}  // namespace mill
