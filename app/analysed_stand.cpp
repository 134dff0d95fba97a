#include "app/analysed_stand.h"
#include "app/review/closed_form_modes.h"
#include "app/trace/closed_form_chain.h"
#include "bearing/pass_frequencies.h"
#include "core/model/case.h"
#include "core/records/csv.h"
#include "core/records/lumped_model.h"
#include "dynamics/chatter/stand_structure.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double unknown_error = 0.10;  // of a given stiffness whose accuracy nobody stated

double load_of(const Pass &pass)
{
  if (!std::isnan(pass.load))
    return pass.load;
  if (!pass.force_file.empty())
    return read_force(pass.force_file).force.mean();
  return (pass.synthetic_range[0] + pass.synthetic_range[1]) / 2;
}

LumpedModel chain_of(const std::vector<ClosedFormResult> &results)
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
  return model;
}

void add_chain(twin::CaseModel &stand, const LumpedModel &model, const DynamicsSettings &settings)
{
  const auto chain = dynamics::mill_model(model, settings);
  const auto modes = dynamics::modes(chain);
  for (std::string label : chain.labels) {
    std::replace(label.begin(), label.end(), ' ', '_');
    stand.places.push_back(label);
  }
  stand.spring_error.resize(Eigen::Index(chain.springs.size()));
  std::string unknown;
  for (std::size_t j = 0; j < chain.springs.size(); ++j) {
    stand.springs.push_back(chain.springs[j].name);
    double error = unknown_error;
    if (j < model.K.size() && std::isfinite(model.K[j].error_estimate))
      error = model.K[j].error_estimate;
    else if (chain.springs[j].stiffness > 0)
      unknown += (unknown.empty() ? "" : ", ") + chain.springs[j].name;
    stand.spring_error[Eigen::Index(j)] = error;
  }
  if (!unknown.empty())
    stand.notes.push_back(
        fmt::format("the accuracy of {} is not known; 10 % was taken where owners are named", unknown));
  stand.frequency     = modes.frequency;
  stand.shape         = modes.shape;
  stand.strain_share  = modes.strain_share;
  stand.kinetic_share = modes.kinetic_share;
}

// The stand of a chatter case without its bite.  Its dampers lie between single masses; what a chain in modes
// keeps of them is the mean of the modes' ratios.
AnalysedChain chain_of(const ChatterCase &spec)
{
  AnalysedChain chain;
  chain.source                 = "six masses of the stand as given, without the bite";
  chain.dynamics.modal_damping = spec.modal_damping;
  if (spec.model)
    chain.model = *spec.model;
  const ChatterStand &stand = spec.stand;
  const std::size_t at[]    = {0, 1, 2, 4, 5, 6};
  for (std::size_t i = 0; !spec.model && i < 6; ++i) {
    const auto given = [](const double value, const char *unit) {
      Parameter parameter;
      parameter.value  = value;
      parameter.unit   = unit;
      parameter.source = Source::given;
      return parameter;
    };
    chain.model.M[i]     = given(stand.masses[i], "kg");
    chain.model.K[at[i]] = given(stand.stiffnesses[i], "N/m");
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

void add_roll(twin::CaseModel &stand, const std::string &name, const double diameter)
{
  if (std::isfinite(diameter))
    stand.rolls.push_back({name, diameter});
}

void add_bearing(twin::CaseModel &stand, const std::vector<RollerBearing> &bearings, const std::string &name,
                 const std::string &roll, const double diameter)
{
  const auto bearing =
      std::find_if(bearings.begin(), bearings.end(), [&](const RollerBearing &b) { return b.name == name; });
  if (bearing == bearings.end())
    return;
  const auto orders = bearing::pass_frequencies(*bearing);
  stand.bearings.push_back({name, roll, diameter, orders.cage, orders.outer, orders.inner, orders.roller});
}
}  // namespace

AnalysedChain analysed_chain(const Case &the_case, const std::string &verb, const double wanted_load)
{
  if (const auto *chatter = std::get_if<ChatterCase>(&the_case.spec); chatter && !chatter->files)
    return chain_of(*chatter);
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    const double load = wanted_load > 0 ? wanted_load : load_of(four->passes.front());
    return {chain_of(closed_form_stand(*four, load)), four->dynamics,
            fmt::format("six masses by closed forms at {:.1f} kN", load / 1e3), load};
  }
  const auto *lumped = std::get_if<Lumped>(&the_case.spec);
  if (!lumped || lumped->detailed)
    throw InputError(
        "millstand " + verb + ": the case " + the_case.path +
        " has no chain of six masses; name a case of kind four-high or chatter, or of kind lumped with [given]");
  return {lumped_model_of(the_case), lumped->dynamics, "six masses as given", not_given};
}

twin::CaseModel analysed_stand(const Case &the_case)
{
  twin::CaseModel stand;
  const AnalysedChain chain = analysed_chain(the_case, "analyse");
  stand.name                = the_case.name;
  stand.source              = chain.source;
  add_chain(stand, chain.model, chain.dynamics);
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    add_roll(stand, "work_roll", four->work_roll.barrel_diameter);
    add_roll(stand, "backup_roll", four->backup_roll.barrel_diameter);
    add_bearing(stand, four->bearings, four->work_roll.bearing, "work_roll", four->work_roll.barrel_diameter);
    add_bearing(stand, four->bearings, four->backup_roll.bearing, "backup_roll",
                four->backup_roll.barrel_diameter);
  } else if (const auto *lumped = std::get_if<Lumped>(&the_case.spec)) {
    add_roll(stand, "work_roll", lumped->campbell.work_roll_diameter);
    add_roll(stand, "backup_roll", lumped->campbell.backup_roll_diameter);
  }
  return stand;
}
}  // namespace mill
