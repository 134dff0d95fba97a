#include "app/trace/quick_chain.h"
#include "app/trace/quick_response.h"
#include "core/records/lumped_model.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "reduce/chain/chain_keys.h"
#include "reduce/stand/lumped_stand.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using Results = std::vector<QuickResult>;

bool has_force(const Pass &pass)
{
  return !pass.force_file.empty() || !std::isnan(pass.synthetic_range[0]);
}

// A given value replaces the computed one; its only input is its own key.
bool is_given(const GivenValues &given, const std::string &name)
{
  return given.count(name) > 0;
}

QuickResult given_result(const std::string &name, const Parameter &parameter)
{
  QuickResult r;
  r.name             = name;
  r.parameter        = parameter;
  r.parameter.inputs = r.closed = {"given." + name};
  r.road                        = "given, nothing is computed";
  r.file                        = "core/case/given";
  return r;
}

const std::array<const char *, 6> mass_names{"M1", "M2", "M3", "M4", "M5", "M6"};
const std::array<const char *, 7> spring_names{"K1", "K2", "K3", "K4", "K5", "K6", "K7"};

// Names of the chain's numbers with the prefix of a pass.
std::vector<std::string> with_prefix(std::vector<std::string> parts, const std::string &prefix)
{
  for (std::string &part : parts)
    part = prefix + part;
  return parts;
}

// Lists of a result that is made of others, and of keys of its own.
void inherit(QuickResult &r, const Results &all, const KeyList &own)
{
  KeyList closed = own, inputs = own;
  for (const std::string &part : r.from)
    if (const QuickResult *made = find(all, part)) {
      closed = joined(closed, made->closed);
      inputs = joined(inputs, made->parameter.inputs);
    }
  r.own              = own;
  r.closed           = closed;
  r.parameter.inputs = joined(inputs, closed);
}

void add_modes(Results &all, const LumpedModel &model, const DynamicsSettings &settings)
{
  const auto modes = dynamics::modes(dynamics::mill_model(model, settings));
  for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
    const Half half = modes.kinetic_share.row(i).head(3).sum() > 0.5 ? Half::upper : Half::lower;
    QuickResult r;
    r.name             = fmt::format("f{}", i + 1);
    r.parameter.value  = modes.frequency[i];
    r.parameter.unit   = "Hz";
    r.parameter.method = "six-mass chain";
    r.from             = chain_parts(settings, half);
    r.road             = "modes of the chain";
    r.file             = "dynamics/response/modes";
    r.equation         = "(6.11)";
    inherit(r, all, {"dynamics.force_meaning", "dynamics.frame"});
    all.push_back(r);
  }
}

// What a roll feels along the pass line; a lumped model may know one stiffness only.
std::string bearing_across(const Results &all, const int roll)
{
  const std::string along = fmt::format("Kzc{}", roll + 1);
  return find(all, along + "_across") ? along + "_across" : along;
}

void add_horizontal_modes(Results &all, const LumpedModel &model, const double chock_seat,
                          const std::array<double, 2> chock_mass)
{
  dynamics::ChockSeats seats;
  seats.stiffness       = {chock_seat, chock_seat};
  seats.chock_mass      = chock_mass;
  const auto horizontal = dynamics::horizontal_model(model, seats);
  if (horizontal.M.size() == 0)
    return;
  const auto modes = dynamics::modes(horizontal);
  for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
    Eigen::Index mover = 0;
    modes.kinetic_share.row(i).maxCoeff(&mover);
    const std::string &label = horizontal.labels[std::size_t(mover)];
    QuickResult r;
    r.name             = fmt::format("fh{}", i + 1);
    r.parameter.value  = modes.frequency[i];
    r.parameter.unit   = "Hz";
    r.parameter.method = label + " on its bearings";
    for (const std::size_t roll : rolls_in(label))
      r.from = {fmt::format("M{}", roll + 2), bearing_across(all, int(roll))};
    r.road     = "horizontal motion on the bearings";
    r.file     = "dynamics/response/mill_model";
    r.equation = "(6.9)";
    inherit(r, all, chock_seat_keys(label, !std::isnan(chock_seat)));
    all.push_back(r);
  }
}

void add_response(Results &all, const LumpedModel &model, const DynamicsSettings &settings, const Pass &pass,
                  const std::size_t p, const std::string &prefix, QuickMemory &memory)
{
  // The six masses are driven here whatever dynamics.model says, and white force has no samples.
  const KeyList all_own = response_keys(settings, pass, p);
  KeyList own;
  for (const std::string &key : all_own)
    if (!holds(detailed_model_keys(), key) && key != "dynamics.output_rate")
      own.push_back(key);
  const bool other_model = settings.model != "six-mass";
  const auto add         = [&](const char *name, const double value, const Half half, const bool white) {
    QuickResult r;
    r.name            = pass.name + "." + name;
    r.parameter.value = value;
    r.parameter.unit  = "g";
    r.parameter.method =
        white ? "six-mass chain under white force of the same rms" : "six-mass chain, exact first-order hold";
    r.from       = with_prefix(chain_parts(settings, half), prefix);
    r.road       = white ? "response to white force of the same size" : "response to the force of " + pass.name;
    r.file       = white ? "app/trace/quick_response" : "dynamics/response/response";
    r.equation   = white ? "(24.3)" : "(7.2)";
    r.stands_for = other_model && !white ? "dynamics.model = \"" + settings.model + "\"" : "";
    inherit(r, all, white ? own : joined(own, keys_in("dynamics", "output_rate")));
    if (!white)
      r.parameter.inputs = joined(r.parameter.inputs, all_own);
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

double factor(const SpringFactors &factors, const std::string &name)
{
  const auto known = factors.find(name);
  return known == factors.end() ? 1 : known->second;
}

// A bearing that is given is known along its load only, and both of a backup roll are twice the given one.
void follow_given_bearing(QuickResult &r, const FourHigh &stand)
{
  const std::string seat = r.name == "K_Zy" ? "Kzc1" : r.name == "K_Zy_lower" ? "Kzc4" : r.name.substr(0, 4);
  if (seat == r.name || seat.substr(0, 3) != "Kzc" || !is_given(stand.given, seat))
    return;
  if (r.name == seat + "_across") {
    r.parameter.value  = not_given;
    r.parameter.inputs = r.closed = {};
  } else if (r.name.substr(0, 4) == "K_Zy") {
    const std::string name = r.name;
    r                      = given_result(seat, stand.given.at(seat).parameter);
    r.name                 = name;
    r.parameter.value *= 2;
  }
}

// Springs that finite elements would give, in closed form or given.
void add_springs(Results &all, const FourHigh &stand, const std::size_t p, const std::string &prefix,
                 const double load, const SpringFactors &factors)
{
  const auto bearings = quick_bearings(stand, load, p);
  std::vector<QuickResult> made{quick_contact(stand, "upper", load, p), quick_contact(stand, "lower", load, p)};
  made.insert(made.end(), bearings.begin(), bearings.end());
  made.push_back(quick_bite(stand, int(p)));
  for (QuickResult &r : made) {
    r.parameter.value *= factor(factors, prefix + r.name);
    follow_given_bearing(r, stand);
    const std::string given = r.name == "K_Zy_lower" ? "K_Zy" : r.name;  // one value for both backup rolls
    if (is_given(stand.given, given)) {
      const std::string name = r.name;
      r                      = given_result(given, stand.given.at(given).parameter);
      r.name                 = name;
      r.load                 = load;
    }
    r.name = prefix + r.name;
    for (std::string &part : r.from)
      part = prefix + part;
    all.push_back(r);
  }
}

// The closed form of a backup roll that a run meshes, times what the last run found.
Parameter bent_beam(const FourHigh &stand, const double found)
{
  Parameter p;
  p.value  = found / reduce::BentBackupRoll(reduce::backup_beam(stand)).flexibility(stand.dynamics.mass_reference);
  p.unit   = "N/m";
  p.method = "stepped Timoshenko beam, " + stand.dynamics.mass_reference + " reference";
  p.inputs = reduce::backup_roll_keys(false);
  return p;
}

// The chain twice: with the keys that closed forms follow, whose numbers count, and with all keys of a run.
LumpedModel add_chain(Results &all, const FourHigh &stand, const std::string &prefix, const std::string &at,
                      const SpringFactors &factors)
{
  const auto made   = [&](const char *name) { return *find(all, prefix + name); };
  const auto spring = [&](const char *name) {
    Parameter p = made(name).parameter;
    p.inputs    = made(name).closed;
    return p;
  };
  if (stand.dynamics.force_meaning != "measured" && std::isnan(made("K4").parameter.value))
    throw InputError("K4 belongs to the chain with force_meaning = \"" + stand.dynamics.force_meaning +
                     "\", and its slab theory has " + made("K4").parameter.method);
  FourHigh tagged = stand;
  set_given_inputs(tagged.given);
  reduce::ChainInputs in;
  in.K3            = spring("K3");
  in.K4            = spring("K4");
  in.K5            = spring("K5");
  in.K_Zy_upper    = spring("K_Zy");
  in.K_Zy_lower    = spring("K_Zy_lower");
  in.Kzc           = {spring("Kzc1"), spring("Kzc2"), spring("Kzc3"), spring("Kzc4")};
  in.Kzc_across    = {spring("Kzc1_across"), spring("Kzc2_across"), spring("Kzc3_across"), spring("Kzc4_across")};
  in.at            = at;
  const bool solid = stand.backup_roll.bending_model == "solid";
  if (solid && !is_given(stand.given, "K_ZW"))
    tagged.given["K_ZW"].parameter = bent_beam(stand, factor(factors, prefix + "K_ZW"));
  const auto chain     = reduce::lumped_stand(tagged, in);
  const auto inputs_of = [&](const char *name) { return made(name).parameter.inputs; };
  auto full            = reduce::chain_keys({inputs_of("K3"), inputs_of("K4"), inputs_of("K5"), inputs_of("K_Zy"),
                                             inputs_of("K_Zy_lower"), reduce::given_springs(stand), stand.housing.present()},
                                            solid);
  for (KeyList &list : full)
    list = reduce::as_drawn(list, stand);
  // What the closed forms do not follow: meshes, and the fillets of a frame of beams.
  const KeyList meshed = joined(mass_shape_keys(stand.dynamics), keys_in("housing", "fillet_radius"));
  const auto add       = [&](const std::string &name, const Parameter &p, const KeyList &inputs) {
    if (is_given(stand.given, name)) {
      all.push_back(given_result(name, p));
    } else {
      const Station place = station_of(name, stand.dynamics.mass_reference);
      QuickResult r;
      r.parameter        = p;
      r.parameter.inputs = joined(inputs, p.inputs);
      for (const std::string &key : p.inputs)
        if (!holds(meshed, key))
          r.closed.push_back(key);
      r.road     = place.road;
      r.file     = place.file;
      r.equation = place.equation;
      r.own      = place.own;
      if (stand.dynamics.mass_source == "fe" && !place.from.empty() && name[0] == 'M')
        r.stands_for = "shapes of the rolls by finite elements, dynamics.mass_source = \"fe\"";
      for (const std::string &part : place.from)
        r.from.push_back(prefix + part);
      all.push_back(r);
    }
    all.back().name = prefix + name;
  };
  add("K_ZW", chain.K_ZW, reduce::backup_roll_keys(solid));
  if (solid && !is_given(stand.given, "K_ZW"))
    all.back().stands_for = "the roll by finite elements, backup_roll.bending_model = \"solid\"";
  for (const std::size_t i : {0, 1, 5, 6})
    add(spring_names[i], chain.model.K[i], full[6 + i]);
  for (std::size_t i = 0; i < 6; ++i)
    add(mass_names[i], chain.model.M[i], full[i]);
  return chain.model;
}

Results four_high(const FourHigh &drawn, QuickMemory &memory, const SpringFactors &factors)
{
  const FourHigh stand = with_drawn_frame(drawn);
  Results all;
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    const Pass &pass         = stand.passes[p];
    const std::string prefix = p == 0 ? "" : pass.name + ".";
    const double load        = std::isnan(pass.load) ? remembered_force(pass, memory).force.mean() : pass.load;
    add_springs(all, stand, p, prefix, load, factors);
    const LumpedModel model = add_chain(all, stand, prefix, fmt::format("{:.1f} kN", load / 1e3), factors);
    if (p == 0) {
      add_modes(all, model, stand.dynamics);
      add_horizontal_modes(all, model, stand.frame.chock_to_housing_stiffness,
                           {2 * stand.work_roll.chock_mass_upper, 2 * stand.work_roll.chock_mass_lower});
    }
    if (has_force(pass))
      add_response(all, model, stand.dynamics, pass, p, prefix, memory);
  }
  return all;
}

Results lumped(const Case &the_case, const Lumped &spec, QuickMemory &memory)
{
  Results all;
  const LumpedModel model = lumped_model_of(the_case);
  const auto add          = [&](const std::string &name, const Parameter &p) {
    if (!std::isnan(p.value))
      all.push_back(given_result(name, p));
  };
  for (std::size_t i = 0; i < 6; ++i)
    add(mass_names[i], model.M[i]);
  for (std::size_t i = 0; i < 7; ++i)
    add(spring_names[i], model.K[i]);
  for (std::size_t i = 0; i < 4; ++i)
    add(fmt::format("Kzc{}", i + 1), model.Kzc[i]);
  add_modes(all, model, spec.dynamics);
  add_horizontal_modes(all, model, not_given, {0, 0});
  for (std::size_t p = 0; p < spec.passes.size(); ++p)
    if (has_force(spec.passes[p]))
      add_response(all, model, spec.dynamics, spec.passes[p], p, "", memory);
  for (QuickResult &r : all)
    for (KeyList *list : {&r.parameter.inputs, &r.closed, &r.own})
      *list = of_kind(*list, the_case.kind);
  return all;
}
}  // namespace

const QuickResult *find(const std::vector<QuickResult> &results, const std::string &name)
{
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const QuickResult &r) { return r.name == name; });
  return found == results.end() ? nullptr : &*found;
}

std::vector<QuickResult> quick_chain(const Case &the_case, QuickMemory &memory, const SpringFactors &factors)
{
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    return four_high(*stand, memory, factors);
  if (const auto *spec = std::get_if<Lumped>(&the_case.spec))
    return lumped(the_case, *spec, memory);
  if (const auto *spec = std::get_if<BearingCase>(&the_case.spec))
    return quick_bearing_case(*spec);
  if (const auto *spec = std::get_if<BiteCase>(&the_case.spec))
    return quick_bite_case(*spec);
  if (const auto *spec = std::get_if<ChatterCase>(&the_case.spec))
    return quick_chatter(*spec);
  return quick_cylinders(std::get<TwoCylinders>(the_case.spec));
}
}  // namespace mill
