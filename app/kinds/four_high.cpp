#include "app/kinds/kind_inputs.h"
#include "app/kinds/manifest_parts.h"
#include "app/kinds/mark_sources.h"
#include "app/kinds/pipeline.h"
#include "app/review/case_review.h"
#include "app/run/run_kind.h"
#include "app/stages/bite/bite_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/trace_key.h"
#include "core/model/case.h"
#include "core/records/result_names.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace mill {
namespace {
using json = nlohmann::ordered_json;

json geometry_of(const FourHigh &stand)
{
  json geometry  = {{"work_roll_diameter", stand.work_roll.barrel_diameter},
                    {"work_roll_length", stand.work_roll.barrel_length},
                    {"work_neck_diameter", stand.work_roll.neck_diameter},
                    {"work_total_length", stand.work_roll.barrel_length + 2 * stand.work_roll.neck_length},
                    {"work_bearing_span", stand.work_roll.bearing_span},
                    {"backup_diameter", stand.backup_roll.barrel_diameter},
                    {"backup_length", stand.backup_roll.barrel_length},
                    {"backup_neck_diameter", stand.backup_roll.neck_diameter},
                    {"backup_neck_length", stand.backup_roll.neck_length},
                    {"backup_bearing_span", stand.backup_roll.bearing_span},
                    {"strip_width", stand.strip.width},
                    {"entry_thickness", stand.strip.entry_thickness},
                    {"exit_thickness", stand.strip.exit_thickness}};
  const auto add = [&](const char *name, const double length) {
    if (length > 0)  // false for what is not given
      geometry[name] = length;
  };
  if (const MillHousing &h = stand.housing; h.present()) {
    add("housing_thickness", h.thickness);
    add("housing_post_width", h.post_width);
    add("housing_window_width", h.window_width);
    add("housing_window_height", h.window_height);
    add("housing_upper_beam_height", h.upper_beam_height);
    add("housing_lower_beam_height", h.lower_beam_height);
  }
  const Screwdown &s = stand.screwdown;
  add("screw_diameter", s.screw_diameter);
  add("screw_length", s.screw_length);
  add("nut_outside_diameter", s.nut_outside_diameter);
  add("nut_height", s.nut_height);
  add("piston_diameter", s.piston_diameter);
  add("piston_length", s.piston_length);
  add("stroke", s.stroke);
  add("load_cell_diameter", s.load_cell_diameter);
  add("load_cell_height", s.load_cell_height);
  return geometry;
}

// K3.* and contact.upper.*, or the same of the lower rolls.
std::optional<KeyList> contact_inputs(const FourHigh &stand, const std::string &name, const std::size_t p)
{
  const bool upper = begins(name, "K3.") || begins(name, "contact.upper.");
  if (!upper && !begins(name, "K5.") && !begins(name, "contact.lower."))
    return {};
  const std::string which = upper ? "upper" : "lower";
  const KeyList keys      = contact_keys(stand, which, p);
  if (ends(name, ".friction_tangent"))
    return joined(keys, keys_in("contact." + which, "friction"));
  return ends(name, ".path_plateau") ? joined(keys, keys_in("contact." + which, "path_trim")) : keys;
}

// bearing.NAME.*: of the upper rolls' seats.
std::optional<KeyList> rating_inputs_of(const FourHigh &stand, const std::string &name)
{
  std::optional<KeyList> keys;
  for (const std::size_t i : {std::size_t(0), std::size_t(1)}) {
    const Roll &roll    = i == 0 ? stand.backup_roll : stand.work_roll;
    const char *section = i == 0 ? "backup_roll" : "work_roll";
    if (!begins(name, "bearing." + roll.bearing + ".") || oil_film_of(stand.oil_films, roll.bearing) ||
        stand.given.count(i == 0 ? "Kzc1" : "Kzc2"))
      continue;
    const KeyList more = joined(seat_keys(stand, i, 0), rating_keys(bearing_of(stand.bearings, roll.bearing)),
                                keys_in(section, "barrel_diameter"), KeyList{"pass.0.speed"});
    keys               = keys ? joined(*keys, more) : more;
  }
  return keys;
}

// stand.* of one pass: the springs on the path of the force, the touching or bending work rolls, the bite.
KeyList modulus_keys(const FourHigh &stand, const Results &results, const std::string &name, const std::size_t p)
{
  const KeyList rolls =
      joined(keys_in("steel", "youngs_modulus poisson_ratio"),
             keys_in("work_roll", "barrel_diameter barrel_length"), load_keys(stand.passes[p], p));
  if (is_of(name, "stand.K_ww"))
    return rolls;
  const auto of_springs = [&](const std::vector<std::string> &springs) {
    KeyList keys;
    for (const std::string &spring : springs)
      if (const Parameter *made = results.find(p == 0 ? spring : result_name({stand.passes[p].name, spring})))
        keys = joined(std::move(keys), made->inputs);
    return keys;
  };
  KeyList bending = joined(keys_in("steel", "youngs_modulus poisson_ratio"), roll_body_keys("work_roll"),
                           keys_in("strip", "width"), keys_in("dynamics", "mass_reference"),
                           keys_in("backup_roll", "bending_model"), of_springs({"K3", "K5"}));
  if (stand.backup_roll.bending_model == BendingModel::solid)
    bending = joined(std::move(bending), keys_in("dynamics", "frequency_limit elements_per_radius"));
  if (is_of(name, "stand.K_bend"))
    return bending;
  const KeyList path = of_springs({"K1", "K2", "K3", "K5", "K6", "K7"});
  if (is_of(name, "stand.modulus.kiss") || is_of(name, "stand.modulus.kiss_secant"))
    return joined(path, rolls);
  const KeyList with_strip = joined(
      path, bending, bite_keys({stand.strip, stand.bite, p, "work_roll.barrel_diameter", true, &stand.passes}));
  return ends(name, ".roll_speed") ? joined(with_strip, keys_in(fmt::format("pass.{}", p), "speed")) : with_strip;
}

std::optional<KeyList> modulus_inputs(const FourHigh &stand, const Results &results, const std::string &name)
{
  if (!is_of(name, family::stand))
    return {};
  for (std::size_t p = 1; p < stand.passes.size(); ++p)
    if (const std::string prefix = result_name({family::stand, stand.passes[p].name}); is_of(name, prefix))
      return modulus_keys(stand, results, family::stand + name.substr(prefix.size()), p);
  return modulus_keys(stand, results, name, 0);
}

std::optional<KeyList> inputs_of(const FourHigh &stand, const Results &results, const std::string &full)
{
  if (const auto keys = modulus_inputs(stand, results, full))
    return keys;
  if (const auto keys = turning_inputs(results, stand.drive.size(), full))
    return keys;
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    const Pass &pass = stand.passes[p];
    if (const auto keys = response_inputs(results, stand.dynamics, pass, p, full))
      return keys;
    const BiteRun bite{stand.strip, stand.bite, p, "work_roll.barrel_diameter", true, &stand.passes};
    if (begins(full, "bite."))
      if (const auto keys = bite_inputs(bite, full, pass.name))
        return keys;
    const std::string prefix = p == 0 ? "" : pass.name + ".";
    const std::string name   = begins(full, prefix) ? full.substr(prefix.size()) : "";
    if (const auto keys = contact_inputs(stand, name, p))
      return keys;
    if (begins(name, "K4."))
      return bite_inputs(bite, name, pass.name);
    if (p == 0)
      if (const auto keys = rating_inputs_of(stand, name))
        return keys;
    const std::string film = "bearing." + stand.backup_roll.bearing;  // of no name where its stiffness is given
    if (begins(name, film + ".film."))
      return joined(seat_keys(stand, stand.given.count("Kzc1") ? 3 : 0, p),
                    ends(name, ".least_speed") ? keys_in(film, "roughness") : KeyList());
    for (std::size_t i = 0; i < 4; ++i)
      if (begins(name, fmt::format("Kzc{}.", i + 1)))
        return seat_keys(stand, i, p);
  }
  return {};
}

std::optional<StandIn> four_high_stand_in(const Case &the_case, const TraceKey &key,
                                          const std::vector<ClosedFormResult> &closed)
{
  const auto &stand = std::get<FourHigh>(the_case.spec);
  if (key.name.rfind("given.", 0) == 0)
    return computed_instead(closed, key.row.key);
  if (const auto pass = pass_of(key)) {
    const std::string prefix = *pass == 0 ? "" : stand.passes[*pass].name + ".";
    if (const ClosedFormResult *contact = find(closed, prefix + "K3");
        key.row.key == "load" && contact && contact->load > 0)
      return StandIn{contact->load, "not given: mean of the force record"};
    return strip_instead(stand.strip, key);
  }
  if (key.name == "strip.initial_thickness")
    return StandIn{stand.strip.entry_thickness, "not given: the entry thickness"};
  if (key.row.key != "bearing_load")
    return {};
  const bool backup               = key.name.rfind("backup_roll.", 0) == 0;
  const ClosedFormResult *bearing = find(closed, backup ? "Kzc1" : "Kzc2");
  if (!bearing)
    return {};
  return StandIn{bearing->load,
                 backup ? "not given: half the rolling force" : "not given: from the rolling force, assumed"};
}
}  // namespace

const RunKind &run_kind(const FourHigh &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::stiffness, Verb::masses, Verb::modes, Verb::chatter, Verb::simulate};
    k.check  = check_bites;
    k.review = review_stand;
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> {
      return {{"condensation", 1}, {"condensation", 10}, {"condensation", 1},
              {"condensation", 8}, {"contact upper", 2}, {"contact lower", 2},
              {"components", 3},   {"bite, curves", 8},  {"passes", 4}};
    };
    k.run = [](RunContext &run, const Goal goal, const std::string &force_file) {
      run_four_high(run, std::get<FourHigh>(run.the_case.spec), goal, force_file);
    };
    k.driven = [](RunContext &run, const std::string &pass) {
      return driven_four_high(run, std::get<FourHigh>(run.the_case.spec), pass);
    };
    k.mark_sources = [](const Case &the_case) { return mark_sources(std::get<FourHigh>(the_case.spec)); };
    k.describe     = [](const Case &the_case, json &manifest) {
      const auto &stand    = std::get<FourHigh>(the_case.spec);
      manifest["geometry"] = geometry_of(stand);
      add_bearings(manifest, stand.bearings);
      add_passes(manifest, stand.passes, stand.dynamics.force_meaning);
    };
    k.inputs = [](const Case &the_case, const Results &results, const std::string &name) {
      return inputs_of(std::get<FourHigh>(the_case.spec), results, name);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &factors) {
      return closed_form_four_high(std::get<FourHigh>(the_case.spec), memory, factors);
    };
    k.stand_in = four_high_stand_in;
    return k;
  }();
  return kind;
}
}  // namespace mill
