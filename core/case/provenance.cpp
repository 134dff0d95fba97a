#include "core/case/provenance.h"
#include "core/base/require.h"
#include "core/case/stand_rows.h"
#include "core/model/case.h"
#include "core/model/lumped_model.h"
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
// All rows of a section but these.
KeyList keys_but(const std::string &section, const std::vector<Row> &rows, const std::string &names)
{
  const KeyList without = words_of(names);
  KeyList keys;
  for (const Row &row : rows)
    if (!holds(without, row.key))
      keys.push_back(section + "." + row.key);
  return keys;
}

std::string pass_section(const std::size_t p)
{
  return fmt::format("pass.{}", p);
}

KeyList elastic_steel()
{
  return keys_in("steel", "youngs_modulus poisson_ratio");
}
}  // namespace

KeyList force_keys(const Pass &pass, const std::size_t p)
{
  const bool recorded = !pass.force_file.empty();
  return keys_in(pass_section(p),
                 recorded ? "force" : "synthetic_range synthetic_duration synthetic_bandwidth synthetic_seed");
}

KeyList load_keys(const Pass &pass, const std::size_t p)
{
  const KeyList load_key = keys_in(pass_section(p), "load");
  return std::isnan(pass.load) ? joined(load_key, force_keys(pass, p)) : load_key;
}

KeyList load_keys_of_all(const std::vector<Pass> &passes)
{
  KeyList keys;
  for (std::size_t p = 0; p < passes.size(); ++p)
    keys = joined(std::move(keys), load_keys(passes[p], p));
  return keys;
}

// Rolls

KeyList roll_body_keys(const std::string &section)
{
  return keys_but(section, section == "work_roll" ? rows_of(work_roll_rows()) : rows_of(backup_roll_rows()),
                  "crown crown_table crown_polynomial thermal_crown thermal_crown_table end_chamfer_length "
                  "end_chamfer_depth axial_shift bending_force bending_model bearing bearing_load "
                  "chock_mass_upper chock_mass_lower");
}

// Contact

KeyList contact_keys(const FourHigh &stand, const std::string &name, const std::size_t p)
{
  // What sits on the ends of a roll, and profiles that another one replaces.
  const auto not_read = [](const Roll &roll) {
    std::string names = "bearing bearing_mass chock_mass_upper chock_mass_lower bearing_load bending_model";
    if (!roll.crown_table.empty())
      names += " crown crown_polynomial";
    else if (!roll.crown_polynomial.empty())
      names += " crown crown_table";
    return roll.thermal_crown_table.empty() ? names : names + " thermal_crown";
  };
  const ContactSettings &settings = name == "upper" ? stand.upper_contact : stand.lower_contact;
  // Without a range of its own the sweep, and with it the mesh, is made for the loads of all passes.
  const KeyList loads =
      std::isnan(settings.loads[0]) ? load_keys_of_all(stand.passes) : load_keys(stand.passes[p], p);
  return joined(elastic_steel(), keys_but("work_roll", rows_of(work_roll_rows()), not_read(stand.work_roll)),
                keys_but("backup_roll", rows_of(backup_roll_rows()), not_read(stand.backup_roll)),
                keys_in("strip", "width"),
                keys_but("contact." + name, rows_of(roll_contact_rows()), "friction path_trim"), loads);
}

namespace {
// A body by its rows, less those that its shape, its rigidity or its profile leave unread.
KeyList body_keys(const std::string &name, const RoundBody &body, const bool in_space)
{
  std::string idle    = body.plane() ? "diameter crown_radius" : "shape";
  const auto not_read = [&](const bool condition, const char *names) {
    idle += condition ? std::string(" ") + names : "";
  };
  not_read(body.rigid, "youngs_modulus poisson_ratio");
  not_read(!in_space, "length crown_radius profile");
  not_read(!in_space || body.profile != EndProfile::arc, "profile_length profile_drop");
  not_read(!in_space || body.profile != EndProfile::log, "profile_load");
  not_read(!in_space || body.profile != EndProfile::table, "profile_table");
  return keys_but(name, rows_of(name == "upper" ? upper_body_rows() : lower_body_rows()), idle);
}
}  // namespace

KeyList cylinder_keys(const TwoCylinders &pair, const std::string &result)
{
  const std::string quantity = result.substr(result.rfind('.') + 1);
  const bool slips           = quantity.rfind("tangential", 0) == 0 || quantity.rfind("stick", 0) == 0;
  const KeyList bodies       = joined(body_keys("upper", pair.upper, pair.in_space),
                                      body_keys("lower", pair.lower, pair.in_space), elastic_steel());
  // Every load has a grid of its own in space and on half planes; a mesh is made for the whole range.
  if (pair.in_space)
    return joined(bodies,
                  keys_in("contact.space", std::string("at rectangles tilt") +
                                               (slips ? " friction tangential_load tangential_direction" : "")));
  const bool planes      = (pair.upper.plane() && !pair.upper.rigid) || (pair.lower.plane() && !pair.lower.rigid);
  const bool meshed      = plane_engine(pair) != PlaneEngine::half_planes && !slips;
  const bool of_curve    = quantity == "tangent";
  const std::string keys = std::string("at") + (slips ? " friction tangential_load" : "") +
                           (meshed ? " loads elements_per_half_width" : "") +
                           (meshed && of_curve ? " samples" : "");
  return joined(bodies, keys_in("contact.line", keys + (planes ? " plane_depth" : "")));
}

// Bearings

KeyList bearing_keys(const RollerBearing &b)
{
  const bool fe = b.roller_law == OneRollerLaw::fe, elastic = b.rings == RingBodies::elastic,
             drawn   = fe || elastic;
  const bool three   = b.profile == RollerProfile::three_parameter;
  const bool rounded = b.profile == RollerProfile::log || b.profile == RollerProfile::lundberg || three;
  const bool tapered = b.type == BearingType::four_row_tapered;
  // Raceway pressures are compared with the yield pressure afterwards; life is rated after all.
  std::string idle =
      "yield_pressure rib_angle viscosity_ratio contamination raceway_flow_stress raceway_flow_state";
  const auto not_read = [&](const bool condition, const char *names) {
    idle += condition ? std::string(" ") + names : "";
  };
  not_read(b.profile == RollerProfile::none && !fe, "slices");
  not_read(b.profile != RollerProfile::table, "profile_table");
  not_read(!(b.profile == RollerProfile::crown || three), "crown_drop");
  not_read(!three, "profile_share");
  not_read(!rounded, "profile_load");
  not_read(!std::isnan(b.end_play) || !std::isnan(b.preload), "radial_clearance");
  not_read(!fe, "roller_total_length");
  not_read(!drawn, "roller_cone_angle");
  not_read(!drawn && !rounded && b.profile != RollerProfile::iso && b.roller_law != OneRollerLaw::elastic,
           "roller_diameter");
  not_read(!drawn && !rounded && b.roller_law != OneRollerLaw::elastic,
           "bore outside_diameter pitch_diameter youngs_modulus poisson_ratio");
  not_read(b.designation.empty(), "designation");
  not_read(b.catalogue.empty(), "catalogue");
  not_read(b.estimated.empty(), "dynamic_rating static_rating");
  not_read(!tapered, "roller_cone_angle cup_angle arrangement end_play preload");
  not_read(!drawn, "width arrangement");
  not_read(!elastic, "chock");
  not_read(!elastic || b.chock == ChockForm::rigid, "chock_width chock_height chock_length");
  not_read(!elastic || b.chock != ChockForm::block, "chock_support_width chock_support_gap");
  return keys_but("bearing." + b.name, rows_of(bearing_rows()), idle);
}

KeyList rating_keys(const RollerBearing &b)
{
  KeyList keys = keys_in("bearing." + b.name, "dynamic_rating static_rating viscosity_ratio contamination "
                                              "roller_diameter pitch_diameter bore outside_diameter arrangement "
                                              "yield_pressure raceway_flow_stress raceway_flow_state");
  return b.type == BearingType::four_row_tapered ? joined(keys, keys_in("bearing." + b.name, "cup_angle")) : keys;
}

KeyList oil_film_keys(const OilFilmBearing &b)
{
  std::string idle    = "type roughness";
  const auto not_read = [&](const bool condition, const char *names) {
    idle += condition ? std::string(" ") + names : "";
  };
  not_read(std::isnan(b.bush_thickness), "bush_modulus bush_poisson_ratio");
  not_read(std::isnan(b.sleeve_thickness), "sleeve_modulus sleeve_poisson_ratio");
  not_read(b.grooves == 0, "groove_angle groove_width groove_length feed_pressure");
  return keys_but("bearing." + b.name, rows_of(oil_film_rows()), idle);
}

KeyList seat_load_keys(const FourHigh &stand, const bool backup, const std::string &contact, const std::size_t p)
{
  const ContactSettings &settings = contact == "upper" ? stand.upper_contact : stand.lower_contact;
  const Roll &roll                = backup ? stand.backup_roll : stand.work_roll;
  const bool bent                 = stand.work_roll.bending_force[0] + stand.work_roll.bending_force[1] != 0;
  KeyList keys                    = keys_in(backup ? "backup_roll" : "work_roll", "bearing bearing_load");
  if (!std::isnan(roll.bearing_load))
    return keys;
  if (backup || !bent || settings.axis_offset != 0)
    keys = joined(std::move(keys), load_keys(stand.passes[p], p));
  if (settings.axis_offset != 0)
    keys = joined(std::move(keys), keys_in("work_roll", "barrel_diameter"),
                  keys_in("backup_roll", "barrel_diameter"));
  return joined(keys, keys_in("work_roll", "bending_force"), keys_in("contact." + contact, "axis_offset"));
}

KeyList seat_keys(const FourHigh &stand, const std::size_t i, const std::size_t p)
{
  const bool backup = i == 0 || i == 3;
  const Roll &roll  = backup ? stand.backup_roll : stand.work_roll;
  if (roll.bearing.empty())  // all of its stiffnesses are given
    return keys_in("given", backup && stand.given.count("K_Zy") ? "K_Zy" : fmt::format("Kzc{}", i + 1));
  KeyList keys = seat_load_keys(stand, backup, i < 2 ? "upper" : "lower", p);
  if (const OilFilmBearing *film = oil_film_of(stand.oil_films, roll.bearing))
    return joined(keys, keys_in(pass_section(p), "speed"), keys_in("backup_roll", "barrel_diameter"),
                  oil_film_keys(*film));
  const auto &b = bearing_of(stand.bearings, roll.bearing);
  if (b.roller_law == OneRollerLaw::fe) {  // one mesh for the heaviest load that any pass puts on this bearing
    keys = joined(std::move(keys), KeyList{"work_roll.bearing", "backup_roll.bearing"});
    for (std::size_t other = 0; other < stand.passes.size(); ++other)
      for (const bool at_backup : {false, true})
        if ((at_backup ? stand.backup_roll : stand.work_roll).bearing == b.name)
          keys = joined(std::move(keys), seat_load_keys(stand, at_backup, "upper", other),
                        seat_load_keys(stand, at_backup, "lower", other));
  }
  return joined(keys, bearing_keys(b));
}

KeyList seat_across_keys(const FourHigh &stand, const std::size_t i, const std::size_t p)
{
  const Roll &roll = i == 0 || i == 3 ? stand.backup_roll : stand.work_roll;
  if (roll.bearing.empty() || oil_film_of(stand.oil_films, roll.bearing))
    return seat_keys(stand, i, p);
  return joined(seat_keys(stand, i, p), keys_in("bearing." + roll.bearing, "slices"));
}

KeyList bearing_case_keys(const BearingCase &spec)
{
  if (const OilFilmBearing *film = oil_film_of(spec.oil_films, spec.load.bearing))
    return joined(keys_in("load", "bearing radial tilt tilt_across speed"), oil_film_keys(*film));
  const RollerBearing &b = bearing_of(spec.bearings, spec.load.bearing);
  KeyList keys           = bearing_keys(b);
  if (loaded_askew(spec.load))
    keys = joined(std::move(keys), keys_in("bearing." + b.name, "width arrangement pitch_diameter slices"));
  for (const Row &row : rows_of(bearing_model_rows()))  // [model] says again what the bearing says
    if (holds(keys, "bearing." + b.name + "." + row.key))
      keys.push_back("model." + row.key);
  const char *swept = b.roller_law == OneRollerLaw::fe ? "loads" : "";  // the mesh is made for the largest of them
  return joined(
      keys_in("load",
              std::string("bearing radial axial tilt cage_angle axial_displacement moment speed ") + swept),
      keys);
}

// Bite

KeyList strip_law_keys(const Strip &strip)
{
  KeyList keys   = keys_in("strip", "flow_stress.law friction.law friction.shear_limit");
  const auto add = [&](const std::string &key) { keys.push_back("strip." + key); };
  if (row_of(strip.flow_stress.law).tabled)
    add("flow_stress.table");
  for (const FlowStressConstant &constant : flow_stress_constants())
    if (reads(strip.flow_stress, constant.member))
      add(std::string("flow_stress.") + constant.key);
  if (hardens(strip.flow_stress))
    add("initial_thickness");
  if (!std::isnan(plain_coefficient(strip.friction)))
    add("friction");  // the number in place of a section
  for (const FrictionConstant &constant : friction_constants())
    if (reads(strip.friction, constant.member))
      add(std::string("friction.") + constant.key);
  return keys;
}

bool follows_width(const std::string &quantity)
{
  return quantity.rfind("force", 0) == 0 || quantity == "torque" || quantity == "plastic_slope";
}

namespace {
KeyList measured_keys(const BiteRun &bite)
{
  KeyList keys       = keys_in("bite", "fit fit_for");
  const auto &passes = *bite.measured;
  const auto asked   = [&](const PassMeasure kind) {
    return std::count(bite.setup.fit.begin(), bite.setup.fit.end(), kind) > 0;
  };
  const std::string strip = "entry_thickness exit_thickness entry_tension exit_tension" +
                            std::string(needs_speed(bite.strip.friction) ? " speed" : "");
  for (std::size_t p = 0; p < passes.size(); ++p) {
    keys = joined(std::move(keys), keys_in(pass_section(p), strip));
    if (asked(PassMeasure::force))
      keys = joined(std::move(keys), load_keys(passes[p], p), keys_in(pass_section(p), "force_deviation"));
    if (asked(PassMeasure::slip))
      keys = joined(std::move(keys), keys_in(pass_section(p), "forward_slip slip_deviation"));
    if (asked(PassMeasure::torque))
      keys = joined(std::move(keys), keys_in(pass_section(p), "torque torque_deviation"));
  }
  return joined(keys, keys_in("strip", "width"));
}
}  // namespace

KeyList slab_keys(const BiteRun &given)
{
  BiteRun bite  = given;
  bite.measured = nullptr;
  if (given.measured && !given.setup.fit.empty())  // the strip is what the model of the run makes of the values
    return joined(bite_keys(bite), measured_keys(given));
  const std::string both = "entry_thickness exit_thickness entry_tension exit_tension";
  const bool fast        = needs_speed(bite.strip.friction);
  return joined(bite.whole_width ? keys_in("strip", "width") : KeyList{}, keys_in("strip", both),
                strip_law_keys(bite.strip), keys_in(pass_section(bite.pass), both + (fast ? " speed" : "")),
                KeyList{bite.roll_key}, elastic_steel(), keys_in("bite", "arc"),
                bite.setup.arc == BiteArc::elastic || bite.setup.arc == BiteArc::automatic
                    ? keys_in("strip", "youngs_modulus poisson_ratio")
                    : KeyList{});
}

KeyList bite_keys(const BiteRun &bite)
{
  const KeyList keys = joined(slab_keys(bite), keys_in("bite", "method"));
  if (bite.setup.method != BiteMethod::fe)
    return joined(keys, keys_in("bite", "theory"));
  const bool elastic = bite.setup.strip != BiteStrip::rigid_plastic;
  return joined(keys, keys_in("bite", "strip elements_along elements_through"),
                elastic ? keys_in("strip", "youngs_modulus poisson_ratio") : KeyList{});
}

KeyList fit_keys(const BiteRun &bite)
{
  return bite.measured && !bite.setup.fit.empty() ? joined(bite_keys(bite), measured_keys(bite)) : KeyList{};
}

// Chain

KeyList spring_keys(const FourHigh &stand, const std::string &name, const std::size_t p)
{
  if (name == "K3" || name == "K5")
    return contact_keys(stand, name == "K3" ? "upper" : "lower", p);
  if (name == "K4")
    return bite_keys({stand.strip, stand.bite, p, "work_roll.barrel_diameter", true, &stand.passes});
  if (name == "K_Zy" || name == "K_Zy_lower")
    return seat_keys(stand, name == "K_Zy" ? 0 : 3, p);
  require(name.rfind("Kzc", 0) == 0, "no keys are known for the spring " + name);
  const auto roll = std::size_t(name.at(3) - '1');
  return name.find("_across") == std::string::npos ? seat_keys(stand, roll, p) : seat_across_keys(stand, roll, p);
}

KeyList mass_shape_keys(const DynamicsSettings &dynamics)
{
  return keys_in("dynamics", dynamics.mass_source == MassSource::fe
                                 ? "mass_source frequency_limit elements_per_radius"
                                 : "mass_source");
}

KeyList detailed_model_keys()
{
  return keys_in("dynamics", "model frequency_limit elements_per_radius");
}

std::vector<std::string> chain_parts(const DynamicsSettings &dynamics, const Half half)
{
  const bool measured = dynamics.force_meaning == ForceMeaning::measured,
             apart    = measured && dynamics.frame == FrameForm::open;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < 6; ++i)
    if (!apart || (i < 3) == (half == Half::upper))
      parts.push_back(fmt::format("M{}", i + 1));
  for (std::size_t i = 0; i < 7; ++i)
    if ((i != 3 || !measured) && (!apart || (i < 3) == (half == Half::upper)))
      parts.push_back(fmt::format("K{}", i + 1));
  return parts;
}

KeyList chain_mode_keys(const LumpedModel &model, const DynamicsSettings &dynamics, const Half half)
{
  KeyList keys;
  for (const std::string &part : chain_parts(dynamics, half)) {
    const auto i = std::size_t(part[1] - '1');
    keys         = joined(std::move(keys), (part[0] == 'M' ? model.M[i] : model.K[i]).inputs);
  }
  return joined(keys, keys_in("dynamics", "frame"));
}

std::vector<std::size_t> rolls_in(const std::string &label)
{
  const char *const rolls[] = {"upper backup roll", "upper work roll", "lower work roll", "lower backup roll"};
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < 4; ++i)
    if (label.find(rolls[i]) != std::string::npos)
      indices.push_back(i);
  return indices;
}

KeyList chock_seat_keys(const std::string &label, const bool seat_given)
{
  KeyList keys;
  for (const std::size_t roll : rolls_in(label)) {
    if (roll == 0 || roll == 3)
      continue;
    keys.push_back("frame.chock_to_housing_stiffness");
    if (seat_given)
      keys.push_back(roll == 1 ? "work_roll.chock_mass_upper" : "work_roll.chock_mass_lower");
  }
  return keys;
}

KeyList horizontal_mode_keys(const LumpedModel &model, const std::string &label, const bool seat_given)
{
  KeyList keys = chock_seat_keys(label, seat_given);
  for (const std::size_t roll : rolls_in(label))
    keys =
        joined(keys, model.M[roll + 1].inputs,
               std::isnan(model.Kzc_across[roll].value) ? model.Kzc[roll].inputs : model.Kzc_across[roll].inputs);
  return keys;
}

KeyList of_kind(const KeyList &keys, const std::string &kind)
{
  std::vector<std::string> sections;
  for (const SectionRows &section : sections_of(kind))
    sections.push_back(section.name);
  KeyList known;
  for (const std::string &key : keys) {
    const bool there = std::any_of(sections.begin(), sections.end(), [&](const std::string &section) {
      return !section.empty() && key.rfind(section + ".", 0) == 0;
    });
    if (there && (kind != "lumped" || !holds(detailed_model_keys(), key)))
      known.push_back(key);
  }
  return known;
}

KeyList response_keys(const DynamicsSettings &dynamics, const Pass &pass, const std::size_t p)
{
  const KeyList keys = joined(force_keys(pass, p),
                              keys_in("dynamics", "modal_damping force_meaning frame output_rate contact model"),
                              dynamics.model != StandModelKind::six_mass ? detailed_model_keys() : KeyList{});
  return dynamics.force_meaning == ForceMeaning::measured ? keys : joined(keys, KeyList{"given.C"});
}

void set_given_inputs(GivenValues &given)
{
  for (auto &[name, value] : given)
    value.parameter.inputs = {"given." + name};
}

void set_given_inputs(LumpedModel &model)
{
  const auto set = [](auto &list, const char *letter) {
    for (std::size_t i = 0; i < list.size(); ++i)
      list[i].inputs = {fmt::format("given.{}{}", letter, i + 1)};
  };
  set(model.M, "M");
  set(model.K, "K");
  set(model.Kzc, "Kzc");
  model.C.inputs = {"given.C"};
}

// Chatter

KeyList chatter_bite_keys(const ChatterCase &spec, const std::size_t i)
{
  KeyList keys = joined(keys_in("work_roll", "diameter"), elastic_steel());
  for (const std::string &key : strip_law_keys(spec.strip))
    if (!has_film(spec.strip.friction) || key.rfind("strip.friction.", 0) != 0)
      keys.push_back(key);
  for (const FrictionConstant &constant : friction_constants())  // a film is that of [oil]
    if (has_film(spec.strip.friction) && reads(spec.strip.friction, constant.member))
      keys.push_back(constant.input);
  return joined(keys, keys_in(fmt::format("condition.{}", i),
                              "entry_thickness exit_thickness entry_tension exit_tension width"));
}

KeyList chatter_stand_keys(const ChatterCase &spec)
{
  const std::string body = spec.model ? "from" : "masses stiffnesses";
  const bool dampers     = !spec.model || !std::isnan(spec.stand.dampings[0]);
  return joined(keys_in("stand", "entry_distance exit_distance " + body + (dampers ? " dampings" : "")),
                keys_in("strip", "youngs_modulus"), keys_in("analysis", "linearisation"));
}
}  // namespace mill
