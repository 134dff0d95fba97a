#include "app/twin/calibrate/detailed_prior.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/model_files.h"
#include "app/twin/calibrate/stated_errors.h"
#include "app/twin/stand/case_chain.h"
#include "app/verbs/driven_case.h"
#include "core/base/force_text.h"
#include "core/model/case.h"
#include "core/records/detailed_model.h"
#include "reduce/stand/stand_modes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
/// The case at one load, without a force of its own, without curves: what its records are compared with.
Case at_one_load(const Case &the_case, const double load)
{
  Case one = the_case;
  if (auto *stand = std::get_if<FourHigh>(&one.spec)) {
    Pass pass               = stand->passes.front();
    pass.load               = case_chain(the_case, "calibrate", load).load;
    pass.force_file         = "";
    pass.synthetic_range    = {not_given, not_given};
    stand->passes           = {pass};
    stand->dynamics.contact = DynamicsSettings().contact;
  }
  if (auto *lumped = std::get_if<Lumped>(&one.spec))
    lumped->passes.clear();
  dynamics_of(one).force_meaning = DynamicsSettings().force_meaning;
  return one;
}

/// The load cell reads one of the connections, whose stiffness is in its row.
void follow_load_cell(StandModel &stand, const Connection &before, const double factor)
{
  if (before.rows.rows() != 1)
    return;
  const Eigen::VectorXd tension = before.stiffness[0] * before.rows.row(0).transpose();
  const double least            = 1e-9 * tension.norm();
  if ((stand.load_cell - tension).norm() < least || (stand.load_cell + tension).norm() < least)
    stand.load_cell *= factor;
}

bool moves(const twin::Calibrated &unknown, const std::string &name)
{
  const auto members = twin::members_of(unknown.name);
  return unknown.name == name || std::find(members.begin(), members.end(), name) != members.end();
}

void scale_mass(StandModel &stand, const int part, const double factor)
{
  for (Eigen::Index i = 0; i < stand.M.rows(); ++i)
    for (Eigen::Index k = 0; k < stand.M.cols(); ++k)
      if (stand.part_of[std::size_t(i)] == part && stand.part_of[std::size_t(k)] == part)
        stand.M(i, k) *= factor;
  for (CarriedMass &carried : stand.carried)
    if (carried.carrier == stand.parts[std::size_t(part)])
      carried.mass *= factor;
}

StandModel calibrated_stand(const StandModel &prior, const twin::Calibration &result)
{
  StandModel stand = prior;
  for (const twin::Calibrated &u : result.unknowns)
    if (u.taken) {
      for (Connection &connection : stand.connections)
        if (moves(u, connection.name)) {
          follow_load_cell(stand, connection, std::exp(u.kept));
          connection.stiffness *= std::exp(u.kept);
          connection.error_estimate = u.sd;
        }
      for (std::size_t part = 0; part < stand.parts.size(); ++part)
        if (moves(u, "mass " + stand.parts[part]))
          scale_mass(stand, int(part), std::exp(u.kept));
    }
  return stand;
}
}  // namespace

bool is_detailed(const Case &the_case)
{
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    return stand->dynamics.model != DynamicsSettings().model;
  const auto *lumped = std::get_if<Lumped>(&the_case.spec);
  return lumped && lumped->detailed;
}

namespace {
/// Masses of the parts, with the errors that the masses of the chain state: M1 upper frame .. M6 lower frame.
void add_masses(PriorChain &prior, const Case &the_case)
{
  std::map<std::string, double> error;
  if (std::holds_alternative<FourHigh>(the_case.spec)) {
    const CaseChain chain        = case_chain(the_case, "calibrate", prior.load);
    const StatedErrors stated    = stated_errors(the_case, chain.model, chain.load);
    const std::string of_chain[] = {"upper frame",     "upper backup roll", "upper work roll",
                                    "lower work roll", "lower backup roll", "lower frame"};
    for (std::size_t i = 0; i < 6; ++i)
      if (const auto stated_error = stated.error.find("M" + std::to_string(i + 1));
          stated_error != stated.error.end())
        error["mass " + of_chain[i]] = stated_error->second;
  }
  for (const twin::ReducedMass &mass : prior.stand.detailed->masses) {
    const auto stated_error = error.find(mass.name);
    prior.masses.push_back(
        {mass.name, prior_of_mass(stated_error == error.end() ? not_given : stated_error->second), 0});
    if (stated_error != error.end())
      prior.stated.push_back(mass.name);
  }
}
}  // namespace

PriorChain detailed_prior(const CommandLine &command, const Case &the_case, const double load)
{
  const Case one           = at_one_load(the_case, load);
  const DrivenStand driven = driven_case(command, one);
  const auto *lumped       = std::get_if<Lumped>(&the_case.spec);
  if (lumped && driven.detailed->model.connections.empty())
    throw InputError(
        lumped->model.place,
        "millstand calibrate: the files of this model do not say its connections, so nothing of it can "
        "be moved; name them with model.connections and model.strains, which a run writes into models/");
  PriorChain prior;
  prior.detailed          = reduce::without(driven.detailed->model, "K4");
  prior.load              = lumped ? not_given : driven.load;
  prior.limit             = driven.dynamics.frequency_limit;
  const StandModel &model = *prior.detailed;
  const auto modes        = reduce::stand_modes(model);
  prior.stand.detailed    = twin::reduced_stand(model, modes.frequency, modes.shape, 2 * prior.limit);
  prior.stand.damping =
      Eigen::VectorXd::Constant(prior.stand.detailed->kept, damping_to_start_from(driven.dynamics));
  prior.source = lumped ? "model " + model.name + " of its files"
                        : fmt::format("{} at {}", title_of(model.name), force_text(prior.load));
  prior.source += fmt::format(", {} modes up to {:.0f} Hz", prior.stand.detailed->kept, 2 * prior.limit);
  for (const StandPoint &point : model.points)
    prior.places.push_back(place_name(point.name));
  for (const Connection &connection : model.connections)
    prior.springs.push_back(
        {connection.name, prior_of_spring(connection.name, connection.error_estimate, true), 0});
  prior.springs.push_back({twin::ratios_name, std::log(2.0), 0});
  add_masses(prior, the_case);
  Case given         = the_case;
  const auto meaning = dynamics_of(given).force_meaning;
  if (meaning != DynamicsSettings().force_meaning)
    prior.notes.emplace_back(
        NoteId::force_meaning, "", std::string("force_meaning = \"") + word_of(meaning) + "\" of the case",
        "a record's force is the whole bite force, so K4 and the gap damper are left out, and the "
        "calibrated case says force_meaning = \"measured\"",
        "", std::vector<std::string>{}, "dynamics.force_meaning");
  prior.notes.insert(prior.notes.end(), driven.warnings.begin(), driven.warnings.end());
  return prior;
}

std::map<std::string, std::string> calibrated_model(const PriorChain &prior, const Case &origin,
                                                    const twin::Calibration &result,
                                                    const std::vector<std::string> &files, const bool accepted,
                                                    const std::string &directory)
{
  reduce::StandWithModes stand{calibrated_stand(*prior.detailed, result), {}};
  stand.modes                         = reduce::stand_modes(stand.model, 2 * prior.limit);
  const ModelFiles named              = model_case_files(stand, prior.limit, not_given);
  auto texts                          = texts_of(stand.model, named);
  Case measured                       = with_damping(origin, result);
  dynamics_of(measured).force_meaning = DynamicsSettings().force_meaning;
  texts["calibrated.toml"] =
      calibration_comment(origin, result, files, accepted) + detailed_model_toml(named, measured, directory);
  return texts;
}
}  // namespace mill
