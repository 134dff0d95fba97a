#include "app/kinds/pipeline.h"
#include "app/command/linked_subjects.h"
#include "app/review/estimate_review.h"
#include "app/run/curve_files.h"
#include "app/run/run_kind.h"
#include "app/stages/bearing/bearing_stage.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/fit_stage.h"
#include "app/stages/bite/free_strip.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/campbell_stage.h"
#include "app/stages/response/contact_curves.h"
#include "app/stages/response/detailed_model_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/response/frf_stage.h"
#include "app/stages/response/turning_rolls.h"
#include "app/stages/stability/critical_speed_stage.h"
#include "app/stages/stand/frame_stage.h"
#include "app/stages/stand/headline.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/model_stage.h"
#include "app/stages/stand/modulus_stage.h"
#include "core/base/name_part.h"
#include "core/case/chain_curves.h"
#include "core/case/given_instead.h"
#include "core/case/lumped_model_toml.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/case/stand_rows.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "core/records/chain_results.h"
#include "core/records/contact_name.h"
#include "core/records/csv.h"
#include "core/records/rows_of_stand.h"
#include "reduce/stand/lumped_stand.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mill {
namespace {
// The result of a number of the chain by its name in the model: "M1", "C", "Kzc1_across".
ResultName chain_result(const std::string &pass, const std::string &number)
{
  const ResultId id = result_id(number).value();
  std::vector<std::string> parts{pass};
  for (const auto &[place, part] : id.places)  // the seat of a bearing
    parts.push_back(part);
  return {*id.row, parts};
}
}  // namespace

void add_chain_results(RunContext &run, const LumpedModel &model, const std::string &pass)
{
  reduce::each_number(
      [&](const std::string &name, const Parameter &number) { run.results.add(chain_result(pass, name), number); },
      model);
}

namespace {
// Adds the published values of the case to the computed ones as checks, under the plain name and for tangent or
// plastic slope.
void add_published_checks(RunContext &run, const GivenValues &published)
{
  std::map<std::string, std::string> solved;  // by the key of a published value
  for (const auto &[key, value] : published)
    if (const auto name = solved_result_of(key))
      solved[key] = *name;
  for (auto &[name, parameter] : run.results.values)
    for (const auto &[key, value] : published)
      if (name == key || (solved.count(key) && name == solved.at(key)))
        parameter.checks.push_back(check(CheckId::published, value.parameter.value, value.parameter.at.text()));
}

void write_shapes(RunContext &run, const reduce::LumpedStand &s)
{
  Table work, backup;
  work.add("x", "m", s.f1_upper.x).add("f1_upper", "m/N", s.f1_upper.value);
  work.add("f1_lower", "m/N", s.f1_lower.value);
  backup.add("x", "m", s.f2_upper.x).add("f2_upper", "m/N", s.f2_upper.value);
  backup.add("f2_lower", "m/N", s.f2_lower.value);
  write_curve(run, curve::shape_work_roll, "", work);
  write_curve(run, curve::shape_backup_roll, "", backup);
}

// K4 over reduction, tension and friction says nothing of masses and modes.
bool draws_bite_curves(const Goal goal)
{
  return goal == Goal::stiffness || goal == Goal::simulate;
}

// What a pass drives: the six masses, or the model that the case asks for.
PassModel model_of_pass(const FourHigh &stand, const reduce::LumpedStand &chain, const StandModels &models)
{
  if (const auto *detailed = driven(models, stand.dynamics))
    return pass_model(*detailed, chain.model, stand.dynamics);
  PassModel six = pass_model(chain.model, stand.dynamics);
  six.missing   = models.verdict.missing;
  return six;
}

// Records and working loads of all passes.
struct PassForces {
  std::vector<ForceRecord> records;
  std::vector<double> loads;  // N
};

PassForces forces_of(RunContext &run, FourHigh &stand, const std::string &force_file)
{
  PassForces forces;
  forces.records.resize(stand.passes.size());
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    Pass &pass          = stand.passes[p];
    ForceRecord &record = forces.records[p];
    if (!force_file.empty())
      pass.force_file = force_file;
    if (has_force(pass))
      record = force_of(pass);
    forces.loads.push_back(working_load(pass, record));
    if (record.force.size() == 0)
      continue;
    if (auto warning = load_against_record(pass, p, record.force.mean()))
      run.warn(std::move(*warning));
  }
  return forces;
}

// What the chain is made of: parts that need nothing of each other.  What is given is not solved.
struct StandParts {
  ComponentSets components;
  std::map<std::string, SolvedContact> contacts;
  std::vector<StandBearings> bearings;  // by pass
  std::vector<BiteSpring> K4;           // by pass
};

// All parts side by side, those that take longest first; results come in the order in which they are taken.
class PartsOfStand {
public:
  PartsOfStand(RunContext &run, const FourHigh &stand, const std::vector<double> &loads, const Goal goal,
               const bool with_bites = true)
      : all(run), n_passes(stand.passes.size())
  {
    parts.K4.resize(n_passes);
    add(contacts, [&](RunContext &part_run) { parts.contacts = solve_contacts(part_run, stand, loads); });
    add(bearings, [&](RunContext &part_run) { parts.bearings = solve_bearings(part_run, stand, loads); });
    add(components, [&, goal](RunContext &part_run) {
      if (goal >= Goal::masses || stand.backup_roll.bending_model == BendingModel::solid)
        parts.components = stand_components(part_run, stand, goal >= Goal::masses);
    });
    for (std::size_t p = 0; p < n_passes; ++p)
      add(first_bite + p, [&, goal, p, with_bites](RunContext &part_run) {
        if (with_bites && !stand.given.count("K4"))
          parts.K4[p] = solve_bite_spring(part_run, stand, p, loads[p], draws_bite_curves(goal));
      });
    all.work();
    for (const std::size_t part : {components, contacts, bearings})
      all.take(part);
  }
  bool has_bite(const std::size_t pass) const  // else take_bite() throws
  {
    return !all.failed(first_bite + pass);
  }
  void take_bite(const std::size_t pass)
  {
    all.take(first_bite + pass);
  }
  StandParts parts;

private:
  enum : std::size_t { contacts, bearings, components, first_bite };
  void add(const std::size_t place, IndependentStage stage)
  {
    if (place != n_added++)
      throw std::logic_error("a part of the stand stands in the wrong place");
    all.add(std::move(stage));
  }
  SideBySide all;
  std::size_t n_passes, n_added = 0;
};

reduce::ChainInputs chain_inputs(const FourHigh &stand, const StandParts &parts, const std::size_t p,
                                 const double load)
{
  reduce::ChainInputs in;
  if (parts.contacts.count("upper"))
    in.K3 = parts.contacts.at("upper").tangent[p];
  if (parts.contacts.count("lower"))
    in.K5 = parts.contacts.at("lower").tangent[p];
  in.K4         = parts.K4[p].combined;
  in.K_Zy_upper = parts.bearings[p].K_Zy_upper;
  in.K_Zy_lower = parts.bearings[p].K_Zy_lower;
  in.Kzc        = parts.bearings[p].Kzc;
  in.Kzc_across = parts.bearings[p].Kzc_across;
  in.K_ww       = touching_work_rolls(stand, load, parts.contacts.count("upper") ? &in.K3 : nullptr);
  in.solid      = solid_rolls(parts.components);
  in.at         = at_force(load);
  return in;
}

// nullptr: its stiffness is given.
const SolvedContact *contact_of(const StandParts &parts, const ContactName contact)
{
  const auto entry = parts.contacts.find(word_of(contact));
  return entry == parts.contacts.end() ? nullptr : &entry->second;
}

// The curves of a pass, as far as its parts have them.
StandCurves curves_of(const FourHigh &stand, const StandParts &parts, const std::size_t p)
{
  const auto curve = [&](const ContactName contact) {
    const SolvedContact *solved = contact_of(parts, contact);
    return solved ? &solved->curve : nullptr;
  };
  // A roller bearing has one curve whatever the pass; an oil film has one for each speed.
  const bool same = !oil_film_of(stand.oil_films, stand.backup_roll.bearing) ||
                    stand.passes[p].speed == stand.passes.front().speed;
  return {curve(ContactName::upper), curve(ContactName::lower),
          same ? &parts.bearings.front().backup_deflection : nullptr};
}

// The mill modulus of a pass, from the results of all stages.
void add_modulus(RunContext &run, const FourHigh &stand, const StandParts &parts, const double load,
                 const std::size_t p, const std::vector<Check> &gaps)
{
  ModulusParts modulus;
  modulus.pass              = p;
  modulus.load              = load;
  modulus.upper             = contact_of(parts, ContactName::upper);
  modulus.lower             = contact_of(parts, ContactName::lower);
  modulus.K4                = parts.K4[p];
  modulus.K_Zy              = {parts.bearings[p].K_Zy_upper, parts.bearings[p].K_Zy_lower};
  modulus.backup_deflection = curves_of(stand, parts, p).bearings;
  modulus.solid             = solid_rolls(parts.components);
  modulus.gap               = gaps;
  add_stand_modulus(run, stand, modulus);
}

// Frequency response of the state that the force drives, Campbell diagram of the one that rolls.
void add_turning_and_response(RunContext &run, const StandStates &states, const StandInState &driven_one,
                              const reduce::LumpedStand &chain, const ComponentSets &components)
{
  const auto &[stand, models] = driven_one;
  const double C              = chain.model.C.value;
  RespondingStand responding;
  responding.models     = {&models.craig_bampton, &models.beam, &models.chain};
  responding.named      = states.name_of(driven_one);
  responding.uncertain  = inputs_of_modes(stand, chain, models, components);
  responding.gap_damper = driven_state(stand.dynamics) == GapState::open || std::isnan(C) ? 0 : C;
  responding.limit      = stand.dynamics.frequency_limit;
  responding.at         = chain.model.at;
  // The work-roll chocks of the components stand on their bearings.
  responding.inputs =
      joined(keys_of_models(*run.keys, chain), chain.model.Kzc[1].inputs, chain.model.Kzc[2].inputs);
  if (driven_state(stand.dynamics) == GapState::rolling)
    responding.inputs = joined(std::move(responding.inputs), chain.model.C.inputs);
  add_frequency_responses(run, stand.frequency_response, stand.dynamics, responding);
  add_campbell(run, stand.campbell,
               {&states.named().models.craig_bampton, turning_rolls(stand), stand.passes, stand.drive});
}

// The frame of the chain; parts that a given K2 or K6 represents are as sure as that.
Frame with_tolerance_of_given(const FourHigh &drawn, Frame frame)
{
  for (const Field<Frame> &row : frame_rows())
    for (const char *spring : {"K2", "K6"})
      if (const auto given = drawn.given.find(spring);
          given != drawn.given.end() && is_needless("frame", row.key, {spring}) &&
          std::isnan(drawn.frame.*std::get<double Frame::*>(row.member)))
        if (const double error = given->second.parameter.error_estimate; !std::isnan(error))
          frame.tolerance[row.key] = error;
  return frame;
}

// The response of a pass to its force.
void drive_pass(RunContext &run, const FourHigh &stand, const reduce::LumpedStand &chain,
                const StandModels &models, const StandParts &parts, const PassForces &forces, const std::size_t p)
{
  const Pass &pass = stand.passes[p];
  if (!has_force(pass)) {
    run.warn({WarningId::pass_without_record,
              "",
              pass.name + " has a load but no force record",
              "nothing was simulated for it",
              "",
              {pass.name},
              "",
              pass.place});
    return;
  }
  PassModel model = model_of_pass(stand, chain, models);
  model.of_pass   = response_keys(*run.keys, p);
  if (stand.dynamics.contact == ContactSprings::curve)
    model.curves = std::make_shared<CurveDrive>(curve_drive(run, curves_of(stand, parts, p), chain,
                                                            driven(models, stand.dynamics), stand.dynamics, pass,
                                                            forces.loads[p]));
  simulate_pass(run, model, stand.dynamics, pass, forces.records[p]);
}

// The chain of one pass, the models that it is compared with, and their results.
// @param gaps  for the mill modulus of the pass, which comes when the bite is there
void run_pass(RunContext &run, const FourHigh &drawn, const StandParts &parts, const PassForces &forces,
              const std::size_t p, const Goal goal, std::vector<Check> &gaps)
{
  const bool first = p == 0;
  const auto in    = chain_inputs(drawn, parts, p, forces.loads[p]);
  auto chain       = reduce::lumped_stand(drawn, in, reduce::StatedErrors::propagated, run.keys.get());
  add_films(chain.model, drawn, parts.bearings[p].film_damper, in);
  FourHigh stand   = drawn;
  stand.frame      = with_tolerance_of_given(drawn, chain.frame);
  const Pass &pass = stand.passes[p];
  StandStates states;
  reduce::FeMasses fe_masses{};
  if (goal >= Goal::masses) {
    states    = stand_states(run, stand, chain, parts.components, !first);
    fe_masses = add_fe_masses(chain.model, stand, states.open.models);
  }
  const StandInState &driven_one = states.driven(stand.dynamics);
  const StandModels &models      = driven_one.models;
  add_chain_results(run, chain.model, first ? "" : pass.name);
  if (first) {
    run.results.add(row::chain::K_ZW.of(), chain.K_ZW);
    run.results.add(row::chain::K_Zy.of(), chain.K_Zy_upper);
    run.results.add(row::chain::K_Zy_lower.of(), chain.K_Zy_lower);
    write_shapes(run, chain);
    std::string curves;
    if (stand.dynamics.contact == ContactSprings::curve)
      curves = chain_curves_toml(chain_curves_of(curves_of(stand, parts, p), chain, forces.loads[p]));
    run.out.write("lumped_model.toml", lumped_model_toml(chain.model, run.the_case, run.out.path()) + curves);
  }
  if (goal >= Goal::modes && first)
    add_modes(run, chain.model, stand.dynamics, stand.frame.chock_to_housing_stiffness,
              {2 * stand.work_roll.chock_mass_upper, 2 * stand.work_roll.chock_mass_lower});
  if (goal >= Goal::masses && first) {
    compare_models(run, states, driven_one, chain, parts.components, fe_masses);
    add_housing_frequencies(run, stand, parts.components);
    add_model_checks(run, states);
    add_modes_by_name(run, states, chain, parts.components);
    run.summary += headline(states, stand.dynamics.frequency_limit);
  }
  if (goal >= Goal::masses)
    gaps = gaps_of(models, stand.dynamics.mass_reference);
  std::vector<IndependentStage> rest;
  if (goal >= Goal::modes && first)
    rest.push_back([&](RunContext &part_run) {
      add_turning_and_response(part_run, states, driven_one, chain, parts.components);
    });
  if (goal >= Goal::simulate)
    rest.push_back([&](RunContext &part_run) { drive_pass(part_run, stand, chain, models, parts, forces, p); });
  if (goal >= Goal::simulate)
    rest.push_back(
        [&](RunContext &part_run) { add_critical_speed(part_run, stand, p, chain, models, parts.components); });
  run_side_by_side(run, std::move(rest));
  if (goal == Goal::chatter)
    linked_subjects.stand_chatter(run, stand, pass, chain, models);
  run.progress.at("passes", double(p + 1) / double(stand.passes.size()));
}
// K4 makes the strip optional, chatter does not.
void require_bite(const Case &the_case)
{
  const std::string missing = missing_of_bite(the_case);
  if (!missing.empty())
    throw InputError(
        "millstand chatter needs " + missing + " (" + the_case.path +
        "): given.K4 is the slope of a bite and does not contain its dependence on speed and tension");
}
}  // namespace

void run_four_high(RunContext &run, FourHigh stand, const Goal goal, const std::string &force_file)
{
  if (goal == Goal::chatter) {
    require_bite(run.the_case);
    stand.dynamics.force_meaning =
        ForceMeaning::measured;  // the stand without the strip, which the bite then adds
  }
  const PassForces forces = forces_of(run, stand, force_file);
  set_given_inputs(stand.given);
  if (goal == Goal::contacts) {
    solve_contacts(run, stand, forces.loads);
    return;
  }
  resolve_frame(run, stand);
  stand.strip = fitted_strip(run, fit_question(stand, forces.loads));
  PartsOfStand made(run, stand, forces.loads, goal);
  close_frame(run, stand, chain_inputs(stand, made.parts, 0, forces.loads[0]));
  SideBySide passes(run);
  std::vector<std::vector<Check>> gaps(stand.passes.size());
  for (std::size_t p = 0; p < stand.passes.size(); ++p)
    passes.add([&, p](RunContext &part_run) {
      if (made.has_bite(p))
        run_pass(part_run, stand, made.parts, forces, p, goal, gaps[p]);
    });
  passes.work();
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    made.take_bite(p);
    passes.take(p);
  }
  for (std::size_t p = 0; p < stand.passes.size(); ++p)
    add_modulus(run, stand, made.parts, forces.loads[p], p, gaps[p]);
  add_published_checks(run, stand.published);
  if (stand.passes.size() > 1)
    run.assume("lumped_model.toml holds the model at the load of " + stand.passes[0].name +
               "; here every pass has its own");
  run.assume("modal damping of " + fmt::format("{:g}", 100 * stand.dynamics.modal_damping) +
             " % in every mode; acceleration levels of a given force range follow (damping x "
             "bandwidth)^(-1/2), so that measured levels "
             "identify only this product");
}

std::size_t place_of_pass(const std::vector<Pass> &passes, const std::string &wanted)
{
  std::string names;
  for (std::size_t p = 0; p < passes.size(); ++p) {
    if (wanted.empty() || passes[p].name == name_part(wanted))
      return p;
    names += (p == 0 ? "\"" : ", \"") + passes[p].name + "\"";
  }
  throw InputError("--pass \"" + wanted + "\": the case has no pass of this name; it has " +
                   (names.empty() ? "none" : names));
}
DrivenStand driven_four_high(RunContext &run, FourHigh stand, const std::string &pass)
{
  const std::size_t p     = place_of_pass(stand.passes, pass);
  const PassForces forces = forces_of(run, stand, "");
  set_given_inputs(stand.given);
  resolve_frame(run, stand);
  // A measured force leaves K4 out, so that no bite has to be solved for it.
  const bool gap_springs = stand.dynamics.force_meaning != ForceMeaning::measured;
  PartsOfStand made(run, stand, forces.loads, Goal::simulate, gap_springs);
  made.take_bite(p);
  close_frame(run, stand, chain_inputs(stand, made.parts, 0, forces.loads[0]));
  DrivenStand driven_stand;
  const auto in = chain_inputs(stand, made.parts, p, forces.loads[p]);
  auto chain    = reduce::lumped_stand(stand, in);
  add_films(chain.model, stand, made.parts.bearings[p].film_damper, in);
  std::optional<StandModels> models;
  const reduce::StandWithModes *detailed = nullptr;
  if (stand.dynamics.model != StandModelKind::six_mass || stand.dynamics.mass_source != MassSource::closed_form) {
    models = stand_models(stand, chain, made.parts.components);
    add_fe_masses(chain.model, stand, *models);
    detailed = driven(*models, stand.dynamics);
    if (detailed) {
      driven_stand.modes    = driven_modes(*detailed, chain.model, stand.dynamics);
      driven_stand.detailed = std::make_shared<const reduce::StandWithModes>(
          with_connection_errors(*detailed, stand, chain, made.parts.components));
    }
  }
  if (!detailed) {
    if (!models)
      models = stand_models(stand, chain, made.parts.components);
    if (auto warning = six_mass_gap_error(*models, stand.dynamics.frequency_limit))
      run.warn(std::move(*warning));
  }
  if (stand.dynamics.contact == ContactSprings::curve)
    driven_stand.curves = std::make_shared<CurveDrive>(curve_drive(
        run, curves_of(stand, made.parts, p), chain, detailed, stand.dynamics, stand.passes[p], forces.loads[p]));
  driven_stand.chain    = chain.model;
  driven_stand.dynamics = stand.dynamics;
  driven_stand.pass     = stand.passes[p];
  driven_stand.force    = forces.records[p];
  driven_stand.load     = forces.loads[p];
  return driven_stand;
}

void run_stages(RunContext &run, const Goal goal, const std::string &force_file)
{
  run_kind(run.the_case).run(run, goal, force_file);
  mark_estimates(run);
}
}  // namespace mill
