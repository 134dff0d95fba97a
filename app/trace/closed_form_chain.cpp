#include "app/trace/closed_form_chain.h"
#include "app/run/run_kind.h"
#include "app/stages/bearing/bearing_stage.h"
#include "app/stages/bite/fit_stage.h"
#include "app/stages/response/detailed_model_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/modulus_stage.h"
#include "app/trace/closed_form_response.h"
#include "app/trace/closed_form_stand.h"
#include "core/base/force_text.h"
#include "core/base/require.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include "core/records/number_in_chain.h"
#include "core/records/rows_of_stand.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "reduce/chain/chain_keys.h"
#include "reduce/stand/lumped_stand.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
using ClosedFormResults = std::vector<ClosedFormResult>;

// A given value replaces the computed one; its only input is its own key.
bool is_given(const GivenValues &given, const std::string &name)
{
  return given.count(name) > 0;
}

ClosedFormResult given_result(const std::string &name, const Parameter &parameter)
{
  ClosedFormResult r;
  r.name             = name;
  r.parameter        = parameter;
  r.parameter.inputs = r.closed = {"given." + name};
  r.relation                    = "given, nothing is computed";
  r.file                        = "core/case/given";
  return r;
}

// @param prefix  "pass 2." of a later pass, whose table has the symbol; empty for the first
void put_in_pass(ClosedFormResult &r, const std::string &prefix)
{
  if (prefix.empty())
    return;
  r.symbol = r.name;
  r.name   = prefix + r.name;
}

// Names of the chain's numbers with the prefix of a pass.
std::vector<std::string> names_of(const std::vector<ChainNumber> &parts, const std::string &prefix = "")
{
  std::vector<std::string> names;
  for (const ChainNumber part : parts)
    names.push_back(prefix + word_of(part));
  return names;
}

// M1, K7, not the bearings that hold the rolls along the pass line, nor a damper.
std::optional<ChainNumber> number_of_chain(const std::string &name)
{
  const auto number = choice_named<ChainNumber>(name);
  return number && (is_mass_of_chain(*number) || is_spring_of_chain(*number)) ? number : std::nullopt;
}

// @param named  state whose names the results have
void add_vertical_modes(ClosedFormResults &all, const LumpedModel &model, const DynamicsSettings &settings,
                        const GapState named, const KeyList &frame_form)
{
  const ChainModes chain = chain_modes(model, settings);
  for (std::size_t i = 0; i < chain.half.size(); ++i) {
    ClosedFormResult r;
    r.name             = row::modes::vertical.of(word_of_state(named), std::to_string(i + 1));
    r.parameter.value  = chain.modes.frequency[Eigen::Index(i)];
    r.parameter.unit   = "Hz";
    r.parameter.method = "six-mass chain";
    r.from             = names_of(chain_parts(settings, chain.half[i]));
    r.relation         = "modes of the chain";
    r.file             = "dynamics/response/modes";
    r.equation         = "(6.11)";
    inherit(r, all, frame_form);
    all.push_back(r);
  }
}

// Modes of both states of the gap, the open one alone where the strip is not known, by number and by name.
void add_modes_of_states(ClosedFormResults &all, const LumpedModel &model, const DynamicsSettings &settings,
                         const std::string &stands_for, MovingKeys *keys)
{
  const KeyList frame_form = keys ? frame_form_keys(*keys) : KeyList();
  for (const GapState state : {GapState::rolling, GapState::open}) {
    if (state == GapState::rolling && !knows_strip(model))
      continue;
    const GapState named = knows_strip(model) ? state : GapState::rolling;
    add_vertical_modes(all, model, in_state(settings, state), named, frame_form);
    add_named_modes_of_chain(all, model, in_state(settings, state), named, stands_for, keys);
  }
}

// What a roll feels along the pass line; a lumped model may know one stiffness only.
std::string bearing_across(const ClosedFormResults &all, const RollPlace roll)
{
  const std::string along = fmt::format("Kzc{}", int(roll) + 1);
  return find(all, along + "_across") ? along + "_across" : along;
}

void add_horizontal_modes(ClosedFormResults &all, const LumpedModel &model, const double chock_seat,
                          const std::array<double, 2> chock_mass, MovingKeys *keys)
{
  const HorizontalModes rolls = horizontal_modes(model, chock_seat, chock_mass);
  for (std::size_t i = 0; i < rolls.mover.size(); ++i) {
    const std::string &label = rolls.mover[i];
    ClosedFormResult r;
    r.name               = fmt::format("fh{}", i + 1);
    r.parameter.value    = rolls.modes.frequency[Eigen::Index(i)];
    r.parameter.unit     = "Hz";
    r.parameter.method   = label + " on its bearings";
    const RollPlace roll = rolls.roll[i];
    r.from               = {fmt::format("M{}", int(roll) + 2), bearing_across(all, roll)};
    r.relation           = "horizontal motion on the bearings";
    r.file               = "dynamics/response/mill_model";
    r.equation           = "(6.9)";
    inherit(r, all, keys ? chock_seat_keys(*keys, roll) : KeyList());
    all.push_back(r);
  }
}

void add_response(ClosedFormResults &all, const LumpedModel &model, const DynamicsSettings &settings,
                  const Pass &pass, const std::size_t p, const std::string &prefix, ClosedFormMemory &memory,
                  MovingKeys *keys)
{
  // The six masses are driven here on linear springs whatever dynamics.model and dynamics.contact say.
  const bool measured = settings.force_meaning == ForceMeaning::measured;
  const auto own      = [&](const ResponseReading reading) {
    return keys ? joined(response_keys(*keys, p, reading), measured ? KeyList() : model.C.inputs) : KeyList();
  };
  const KeyList of_run = own(ResponseReading::model), driven = own(ResponseReading::six_masses),
                under_white = own(ResponseReading::white);
  const bool other_model    = settings.model != StandModelKind::six_mass;
  const auto add            = [&](const char *name, const double value, const Half half, const bool white) {
    ClosedFormResult r;
    r.name            = pass.name + "." + name;
    r.parameter.value = value;
    r.parameter.unit  = "g";
    r.parameter.method =
        white ? "six-mass chain under white force of the same rms" : "six-mass chain, exact first-order hold";
    r.from     = names_of(chain_parts(settings, half), prefix);
    r.relation = white ? "response to white force of the same size" : "response to the force of " + pass.name;
    r.file     = white ? "app/trace/closed_form_response" : "dynamics/response/response";
    r.equation = white ? "(24.3)" : "(7.2)";
    r.stands_for =
        other_model && !white ? std::string("dynamics.model = \"") + word_of(settings.model) + "\"" : "";
    inherit(r, all, white ? under_white : driven);
    if (!white)
      r.parameter.inputs = joined(std::move(r.parameter.inputs), of_run);
    all.push_back(r);
  };
  const auto levels = driven_levels(model, settings, pass, memory);
  const auto white  = white_levels(model, settings, pass, memory);
  add("peak_g.upper_work_roll", levels[0], Half::upper, false);
  add("rms_g.upper_work_roll", levels[1], Half::upper, false);
  add("peak_g.lower_work_roll", levels[2], Half::lower, false);
  add("rms_g.lower_work_roll", levels[3], Half::lower, false);
  if (std::isnan(white[0]))
    return;
  add("white_rms_g.upper_work_roll", white[0], Half::upper, true);
  add("white_rms_g.lower_work_roll", white[1], Half::lower, true);
}

// A bearing that is given is known along its load only.
bool is_across_given_bearing(const std::string &name, const GivenValues &given)
{
  const auto spring = spring_named(name);
  return spring && spring->across && is_given(given, word_of(spring->number));
}

// Both bearings of a backup roll are twice the given one.
void follow_given_bearing(ClosedFormResult &r, const FourHigh &stand)
{
  const auto number = choice_named<ChainNumber>(r.name);
  if (number != ChainNumber::K_Zy && number != ChainNumber::K_Zy_lower)
    return;
  const std::string seat = word_of(number == ChainNumber::K_Zy ? ChainNumber::Kzc1 : ChainNumber::Kzc4);
  if (!is_given(stand.given, seat))
    return;
  const std::string name = r.name;
  r                      = given_result(seat, stand.given.at(seat).parameter);
  r.name                 = name;
  r.parameter.value *= 2;
}

// Springs that finite elements would give, in closed form or given.
void add_springs(ClosedFormResults &all, const FourHigh &stand, const std::size_t p, const std::string &prefix,
                 const double load, ClosedFormMemory &memory, const SpringFactors &factors, MovingKeys *keys)
{
  const auto bearings = closed_form_bearings(stand, load, p, memory, keys);
  std::vector<ClosedFormResult> made{closed_form_contact(stand, "upper", load, p),
                                     closed_form_contact(stand, "lower", load, p)};
  made.insert(made.end(), bearings.begin(), bearings.end());
  if (is_given(stand.given, "K4"))  // the strip may be unknown
    made.push_back(given_result("K4", stand.given.at("K4").parameter));
  else
    made.push_back(closed_form_bite(stand, int(p), keys));
  for (ClosedFormResult &r : made) {
    if (is_across_given_bearing(r.name, stand.given))
      continue;  // it is not known, as in a run
    if (const auto spring = spring_named(r.name); keys && spring)
      r.parameter.inputs = spring_keys(*keys, *spring, p);
    r.parameter.value *= factor(factors, prefix + r.name);
    follow_given_bearing(r, stand);
    const std::string given =
        r.name == word_of(ChainNumber::K_Zy_lower) ? "K_Zy" : r.name;  // one value for both backup rolls
    if (is_given(stand.given, given)) {
      const std::string name = r.name;
      r                      = given_result(given, stand.given.at(given).parameter);
      r.name                 = name;
      r.load                 = load;
    }
    put_in_pass(r, prefix);
    for (std::string &part : r.from)
      part = prefix + part;
    all.push_back(r);
  }
}

// The closed form of a backup roll that a run meshes, times the factor of the last run; one roll for all passes.
Parameter bent_beam(const FourHigh &stand, const SpringFactors &factors)
{
  const double run_factor = factor(factors, "K_ZW");
  Parameter p;
  p.value = run_factor * beam_stiffness(stand);
  p.unit  = "N/m";
  p.method =
      std::string("stepped Timoshenko beam, ") + word_of(stand.dynamics.mass_reference) + " reference" +
      (run_factor == 1 ? ""
                       : fmt::format(", times {:.4g}, the solid roll of the last run over its beam", run_factor));
  return p;
}

// The closed form bends a beam, whatever the case asks for: what a run follows in the model is left out.
KeyList as_beam(KeyList keys)
{
  const KeyList choice = keys_in("backup_roll", "bending_model");
  keys.erase(std::remove(keys.begin(), keys.end(), choice.front()), keys.end());
  return keys;
}

// The chain twice: with the keys that closed forms follow, whose numbers count, and with all keys of a run.
reduce::LumpedStand add_chain(ClosedFormResults &all, FourHigh &stand, const std::size_t pass, const double load,
                              const SpringFactors &factors, MovingKeys *keys)
{
  const std::string prefix = pass == 0 ? "" : stand.passes[pass].name + ".";
  const auto made          = [&](const std::string &name) {
    const ClosedFormResult *spring = find(all, prefix + name);
    require(spring, "no closed form gives the spring " + name);
    return *spring;
  };
  if (stand.dynamics.force_meaning != ForceMeaning::measured && std::isnan(made("K4").parameter.value))
    throw InputError("K4 belongs to the chain with force_meaning = \"" +
                     std::string(word_of(stand.dynamics.force_meaning)) + "\", and its slab theory has " +
                     made("K4").parameter.method);
  FourHigh tagged = stand;
  set_given_inputs(tagged.given);
  reduce::ChainInputs in;
  reduce::each_spring(
      [&](const std::string &name, Parameter &p) {
        if (is_across_given_bearing(name, stand.given))
          return;
        p        = made(name).parameter;
        p.inputs = made(name).closed;
      },
      in);
  in.at            = force_text(load);
  in.K_ww          = touching_work_rolls(stand, load, nullptr);
  const bool solid = stand.backup_roll.bending_model == BendingModel::solid;
  if (solid && !is_given(stand.given, "K_ZW"))
    tagged.given["K_ZW"].parameter = bent_beam(stand, factors);
  if (pass == 0)  // the later ones take the same frame
    stand.frame = tagged.frame = reduce::frame_on_modulus(tagged, in);
  auto chain = reduce::lumped_stand(tagged, in, reduce::StatedErrors::none);
  add_films(chain.model, tagged, {made("K_Zy").film_damper, made("K_Zy_lower").film_damper}, in);
  // Keys that the closed forms follow, and those of a run, which has meshes.
  std::array<KeyList, 13> closed, full;
  KeyList closed_bending, bending;
  if (keys) {
    const auto list = [&](const char *name) { return made(name).parameter.inputs; };
    closed          = reduce::chain_keys(
                 *keys, stand, {in.K3.inputs, in.K4.inputs, in.K5.inputs, in.K_Zy_upper.inputs, in.K_Zy_lower.inputs},
                 false, ChainReading::closed_form);
    full = reduce::chain_keys(*keys, stand, {list("K3"), list("K4"), list("K5"), list("K_Zy"), list("K_Zy_lower")},
                              solid);
    closed_bending = as_beam(bent_backup_keys(*keys, false, false));
    for (KeyList &followed : closed)
      followed = as_beam(std::move(followed));
    bending = bent_backup_keys(*keys, solid, false);
  }
  const auto add = [&](const std::string &name, const Parameter &p, const KeyList &followed,
                       const KeyList &inputs) {
    if (is_given(stand.given, name)) {
      all.push_back(given_result(name, p));
    } else {
      const Station place = station_of(name, stand.dynamics.mass_reference, keys);
      ClosedFormResult r;
      r.parameter         = p;
      r.parameter.inputs  = joined(inputs, followed);
      r.closed            = followed;
      r.relation          = place.relation;
      r.file              = place.file;
      r.equation          = place.equation;
      r.own_keys          = place.own_keys;
      const auto of_chain = number_of_chain(name);
      const bool is_mass  = of_chain && is_mass_of_chain(*of_chain) && !place.from.empty();
      if (stand.dynamics.mass_source == MassSource::fe && is_mass)
        r.stands_for = "shapes of the rolls by finite elements, dynamics.mass_source = \"fe\"";
      else if (solid && is_mass)
        r.stands_for = "shapes of the rolls by finite elements, backup_roll.bending_model = \"solid\"";
      for (const std::string &part : place.from)
        r.from.push_back(prefix + part);
      all.push_back(r);
    }
    all.back().name = name;
    put_in_pass(all.back(), prefix);
  };
  add("K_ZW", chain.K_ZW, closed_bending, bending);
  if (solid && !is_given(stand.given, "K_ZW"))
    all.back().stands_for = "the roll by finite elements, backup_roll.bending_model = \"solid\"";
  // The numbers that were not added above, in the order of the relations: springs, then masses.
  for (const auto is_wanted : {is_spring_of_chain, is_mass_of_chain}) {
    std::size_t place = 0;  // in both lists
    reduce::each_number(
        [&](const std::string &name, const Parameter &number) {
          const auto of_chain = number_of_chain(name);
          if (!of_chain)
            return;
          const std::size_t i = place++;
          if (is_wanted(*of_chain) && !find(all, prefix + name))
            add(name, number, closed[i], full[i]);
        },
        chain.model);
  }
  return chain;
}

}  // namespace

ClosedFormResults closed_form_four_high(const FourHigh &drawn, ClosedFormMemory &memory,
                                        const SpringFactors &factors)
{
  FourHigh stand = with_drawn_frame(drawn);
  std::vector<double> loads;
  for (const Pass &pass : stand.passes)
    loads.push_back(std::isnan(pass.load) ? remembered_force(pass, memory).force.mean() : pass.load);
  stand.strip     = quickly_fitted_strip(fit_question(stand, loads));
  const auto keys = wanted_keys(memory, stand);
  ClosedFormResults all;
  memory.stands.clear();
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    const Pass &pass         = stand.passes[p];
    const std::string prefix = p == 0 ? "" : pass.name + ".";
    const double load        = loads[p];
    add_springs(all, stand, p, prefix, load, memory, factors, keys.get());
    const auto chain         = add_chain(all, stand, p, load, factors, keys.get());
    const LumpedModel &model = chain.model;
    memory.stands.push_back({std::make_shared<FourHigh>(stand), model});
    if (p == 0) {
      add_quick_modulus(all, stand, load, factors, keys.get());
      add_modes_of_states(all, model, stand.dynamics, "rolls as reduced finite elements", keys.get());
      add_horizontal_modes(all, model, stand.frame.chock_to_housing_stiffness,
                           {2 * stand.work_roll.chock_mass_upper, 2 * stand.work_roll.chock_mass_lower},
                           keys.get());
    }
    if (has_force(pass) && memory.with_responses)
      add_response(all, model, stand.dynamics, pass, p, prefix, memory, keys.get());
  }
  return all;
}

namespace {
// Modes of given matrices: nothing but the files stands behind them.
ClosedFormResults closed_form_model_in_files(const ModelFiles &files)
{
  const reduce::StandWithModes s = model_from_files(files);
  ClosedFormResults all;
  for (Eigen::Index i = 0; i < s.modes.frequency.size() && s.modes.frequency[i] <= files.frequency_limit; ++i) {
    ClosedFormResult r;
    r.name             = fmt::format("f{}", i + 1);
    r.parameter.value  = s.modes.frequency[i];
    r.parameter.unit   = "Hz";
    r.parameter.method = "matrices of model " + files.name;
    r.parameter.inputs = r.closed = r.own_keys = keys_in("model", "mass stiffness");
    r.relation                                 = "modes of the matrices";
    r.file                                     = "reduce/stand/stand_modes";
    r.equation                                 = "(6.11)";
    all.push_back(r);
  }
  return all;
}
}  // namespace

ClosedFormResults closed_form_lumped(const Case &the_case, ClosedFormMemory &memory)
{
  const auto &spec = std::get<Lumped>(the_case.spec);
  ClosedFormResults all;
  if (spec.detailed)
    return closed_form_model_in_files(spec.model);
  LumpedModel model = lumped_model_of(the_case);
  set_given_inputs(model);
  const auto keys = wanted_keys(memory, the_case.spec);
  reduce::each_number(
      [&](const std::string &name, const Parameter &number) {
        if (number_of_chain(name) || is_bearing(name))
          all.push_back(given_result(name, number));
      },
      model);
  add_modes_of_states(all, model, spec.dynamics, "", keys.get());
  add_horizontal_modes(all, model, not_given, {0, 0}, keys.get());
  for (std::size_t p = 0; p < spec.passes.size(); ++p)
    if (has_force(spec.passes[p]) && memory.with_responses)
      add_response(all, model, spec.dynamics, spec.passes[p], p, "", memory, keys.get());
  return all;
}

std::unique_ptr<MovingKeys> wanted_keys(const ClosedFormMemory &memory, const CaseSpec &spec)
{
  return memory.with_inputs ? std::make_unique<MovingKeys>(spec) : nullptr;
}

double factor(const SpringFactors &factors, const std::string &name)
{
  const auto known = factors.find(name);
  return known == factors.end() ? 1 : known->second;
}

void inherit(ClosedFormResult &r, const std::vector<ClosedFormResult> &all, const KeyList &own_keys)
{
  KeyList closed = own_keys, inputs = own_keys;
  for (const std::string &part : r.from)
    if (const ClosedFormResult *made = find(all, part)) {
      closed = joined(std::move(closed), made->closed);
      inputs = joined(std::move(inputs), made->parameter.inputs);
    }
  r.own_keys         = own_keys;
  r.closed           = closed;
  r.parameter.inputs = joined(std::move(inputs), closed);
}

const ClosedFormResult *find(const std::vector<ClosedFormResult> &results, const std::string &name)
{
  const auto match =
      std::find_if(results.begin(), results.end(), [&](const ClosedFormResult &r) { return r.name == name; });
  return match == results.end() ? nullptr : &*match;
}

double beam_stiffness(const FourHigh &stand)
{
  return 1 / reduce::BentBackupRoll(reduce::backup_beam(stand)).flexibility(stand.dynamics.mass_reference);
}

std::vector<ClosedFormResult> closed_form_chain(const Case &the_case, ClosedFormMemory &memory,
                                                const SpringFactors &factors)
{
  return run_kind(the_case).trace(the_case, memory, factors);
}
}  // namespace mill
