#include "app/case_chain.h"
#include "app/review/closed_form_modes.h"
#include "app/trace/closed_form_chain.h"
#include "core/model/case.h"
#include "core/records/csv.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
double load_of_pass(const Pass &pass)
{
  if (!std::isnan(pass.load))
    return pass.load;
  if (!pass.force_file.empty())
    return read_force(pass.force_file).force.mean();
  return (pass.synthetic_range[0] + pass.synthetic_range[1]) / 2;
}

LumpedModel chain_of_results(const std::vector<ClosedFormResult> &results)
{
  LumpedModel model;
  const auto take = [&](const std::string &name, Parameter &into) {
    if (const ClosedFormResult *found = find(results, name))
      into = found->parameter;
  };
  for (std::size_t i = 0; i < model.M.size(); ++i)
    take("M" + std::to_string(i + 1), model.M[i]);
  for (std::size_t i = 0; i < model.K.size(); ++i)
    take("K" + std::to_string(i + 1), model.K[i]);
  take("C", model.C);
  return model;
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
    chain.source   = fmt::format("six masses by closed forms at {:.1f} kN", chain.load / 1e3);
    return chain;
  }
  const auto *lumped = std::get_if<Lumped>(&the_case.spec);
  if (!lumped || lumped->detailed)
    throw InputError("millstand " + verb + ": the case " + the_case.path +
                     " has no chain of six masses; name a case of kind four-high, or of kind lumped with [given]");
  chain.model    = lumped_model_of(the_case);
  chain.dynamics = lumped->dynamics;
  chain.source   = "six masses as given";
  return chain;
}
}  // namespace mill
