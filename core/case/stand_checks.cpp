#include "core/base/units.h"
#include "core/case/chain_curves.h"
#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/model/four_high.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace mill {
void contradict(Reading &reading, const std::string &key, const std::string &why,
                const std::vector<std::string> &others)
{
  std::vector<Place> related;
  for (const std::string &other : others)
    if (reading.places.count(other))
      related.push_back(reading.place(other));
  reading.add(reading.place(key), reading.as_written(key) + " " + why, std::move(related));
}

std::string millimetres(const double length)
{
  return fmt::format("{:.5g} mm", from_si(length, unit("mm")));
}

std::string degrees(const double angle)
{
  return fmt::format("{:.2f} deg", from_si(angle, unit("deg")));
}

void check_profile(const std::string &name, const Roll &roll, Reading &reading)
{
  const auto key   = [&](const char *k) { return name + "." + k; };
  const auto given = [&](const char *k) { return reading.places.count(key(k)) > 0; };
  for (const auto &[one, other] :
       {std::pair("crown", "crown_table"), std::pair("crown", "crown_polynomial"),
        std::pair("crown_table", "crown_polynomial"), std::pair("thermal_crown", "thermal_crown_table")})
    if (given(one) && given(other))
      contradict(reading, key(one), fmt::format("is given together with a {}; give one of the two", other),
                 {key(other)});
  for (const auto &[name_of, table] :
       {std::pair("crown_table", &roll.crown_table), std::pair("thermal_crown_table", &roll.thermal_crown_table)})
    if (reading.usable({key(name_of), key("barrel_length")}) && !table->empty()) {
      const double reach = std::max(-table->front()[0], table->back()[0]);
      // one part in 1e9 for the rounding of the units
      if (reach > roll.barrel_length / 2 * (1 + 1e-9))
        contradict(reading, key(name_of),
                   fmt::format("reaches {} from mid-length; the barrel ends at {}", millimetres(reach),
                               millimetres(roll.barrel_length / 2)),
                   {key("barrel_length")});
    }
  if (reading.usable({key("crown_polynomial")}))
    for (const auto &term : roll.crown_polynomial)
      if (term[0] != std::floor(term[0]) || term[0] < 1 || term[0] > 12) {
        contradict(reading, key("crown_polynomial"), "needs whole powers from 1 to 12 in its first column", {});
        break;
      }
  if (reading.usable({key("end_chamfer_length"), key("barrel_length")}) &&
      roll.end_chamfer_length > roll.barrel_length / 2)
    contradict(reading, key("end_chamfer_length"), "is longer than half the barrel", {key("barrel_length")});
  if (reading.usable({key("end_chamfer_length"), key("end_chamfer_depth")}) && roll.end_chamfer_depth > 0 &&
      roll.end_chamfer_length == 0)
    contradict(reading, key("end_chamfer_depth"), "needs an end_chamfer_length over which the radius falls", {});
}

namespace {
// What work roll and backup roll have in common.
void check_roll(const std::string &name, const Roll &roll, Reading &reading)
{
  const auto key = [&](const char *k) { return name + "." + k; };
  if (reading.usable({key("neck_diameter"), key("barrel_diameter")}) && roll.neck_diameter > roll.barrel_diameter)
    contradict(reading, key("neck_diameter"), "is larger than the barrel", {key("barrel_diameter")});
  if (reading.usable({key("bearing_span"), key("barrel_length")}) && roll.bearing_span <= roll.barrel_length)
    contradict(reading, key("bearing_span"),
               fmt::format("puts the bearing centres inside the barrel, which is {} long",
                           millimetres(roll.barrel_length)),
               {key("barrel_length")});
  check_profile(name, roll, reading);
}

void check_file(const std::string &key, const std::string &file, Reading &reading)
{
  std::error_code ignored;
  if (file.empty() || std::filesystem::is_regular_file(file, ignored))
    return;
  reading.add(reading.place(key),
              fmt::format(std::filesystem::exists(file, ignored) ? "{}: {} is not a regular file; name one"
                                                                 : "{}: the file {} does not exist",
                          reading.as_written(key), file) +
                  (file.find('\\') != std::string::npos ? "; write / between the names of folders" : ""));
}
}  // namespace

void check_work_roll(const WorkRollInput &roll, Reading &reading)
{
  check_roll("work_roll", roll, reading);
  if (reading.usable({"work_roll.total_length", "work_roll.barrel_length"}) &&
      roll.total_length <= roll.barrel_length)
    contradict(reading, "work_roll.total_length", "is not longer than the barrel", {"work_roll.barrel_length"});
  if (reading.usable({"work_roll.total_length", "work_roll.bearing_span"}) &&
      roll.bearing_span >= roll.total_length)
    contradict(reading, "work_roll.bearing_span", "puts the bearing centres beyond the ends of the roll",
               {"work_roll.total_length"});
}

void check_backup_roll(const Roll &roll, Reading &reading)
{
  check_roll("backup_roll", roll, reading);
  if (reading.usable({"backup_roll.barrel_length", "backup_roll.neck_length", "backup_roll.bearing_span"}) &&
      roll.bearing_span >= roll.barrel_length + 2 * roll.neck_length)
    contradict(reading, "backup_roll.bearing_span", "puts the bearing centres beyond the ends of the roll",
               {"backup_roll.barrel_length", "backup_roll.neck_length"});
}

void check_passes(const std::vector<Pass> &passes, Reading &reading)
{
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const Pass &pass       = passes[i];
    const std::string name = fmt::format("pass.{}", i);
    const auto key         = [&](const char *k) { return name + "." + k; };
    const bool has_range   = reading.places.count(key("synthetic_range")) > 0;
    check_file(key("force"), pass.force_file, reading);
    check_file(key("measured"), pass.measured_file, reading);
    if (!reading.usable({key("name"), key("force"), key("load"), key("synthetic_range")}))
      continue;
    if (pass.force_file.empty() && std::isnan(pass.load) && !has_range)
      reading.add(
          pass.place,
          fmt::format("pass \"{}\" has no force; add force = \"FILE.csv\", synthetic_range or load", pass.name));
    if (!pass.force_file.empty() && has_range)
      contradict(reading, key("synthetic_range"), "is given together with a force file; give one of the two",
                 {key("force")});
    if (has_range && !(pass.synthetic_range[0] < pass.synthetic_range[1]))
      contradict(reading, key("synthetic_range"), "does not increase; write the smaller force first", {});
  }
  check_pass_names(passes, reading);
}

void check_contact(const std::string &section, const ContactSettings &contact, Reading &reading)
{
  const std::string loads = section + ".loads", load = section + ".at";
  if (reading.usable({section + ".tilt", section + ".load_offset"}) && !std::isnan(contact.tilt) &&
      !std::isnan(contact.load_offset))
    contradict(reading, section + ".tilt", "is given together with a load_offset; each follows from the other",
               {section + ".load_offset"});
  if (!reading.usable({loads}) || std::isnan(contact.loads[0]))
    return;
  if (!(contact.loads[0] < contact.loads[1]))
    contradict(reading, loads, "does not increase; write the smaller load first", {});
  else if (reading.usable({load}) && (contact.at < contact.loads[0] || contact.at > contact.loads[1]))
    contradict(reading, load, "is outside " + reading.as_written(loads) + "; change one of the two", {loads});
}

void check_published_force(const DynamicsSettings &dynamics, const GivenValues &given, Reading &reading)
{
  if (dynamics.force_meaning != ForceMeaning::published || !reading.usable({"given.K4", "given.C"}))
    return;
  std::string missing;
  for (const char *key : {"K4", "C"})
    if (!given.count(key))
      missing += (missing.empty() ? "" : " and ") + std::string(key);
  if (!missing.empty())
    contradict(reading, "dynamics.force_meaning", fmt::format("needs {} in [given]", missing), {});
}

namespace {
// A frame that moves needs a mass to move; which of its parts has it is the user's to say.
void check_frame_mass(const FourHigh &stand, Reading &reading)
{
  const Frame &f      = stand.frame;
  const auto massless = [&](const char *mass, const std::vector<std::string> &keys, const double sum) {
    if (stand.housing.present() || stand.given.count(mass) || !reading.usable(keys) || sum != 0)
      return;
    std::string named;
    for (const std::string &key : keys)
      named += (named.empty() ? "" : key == keys.back() ? " and " : ", ") + key;
    reading.add(reading.place(keys.front()),
                fmt::format("{} are all zero; {} needs a mass: give one of them, or given.{}", named, mass, mass));
  };
  massless("M1",
           {"frame.upper_post_mass", "frame.upper_beam_mass", "frame.upper_packing_mass", "frame.piston_mass"},
           f.upper_post_mass + f.upper_beam_mass + f.upper_packing_mass + f.piston_mass);
  massless("M6",
           {"frame.lower_post_mass", "frame.lower_beam_mass", "frame.load_cell_mass", "frame.lower_packing_mass"},
           f.lower_post_mass + f.lower_beam_mass + f.load_cell_mass + f.lower_packing_mass);
}
}  // namespace

void check_four_high(const FourHigh &stand, Reading &reading)
{
  check_frame_mass(stand, reading);
  if (reading.usable({"work_roll.barrel_diameter", "backup_roll.barrel_diameter"}) &&
      stand.backup_roll.barrel_diameter < stand.work_roll.barrel_diameter)
    contradict(reading, "backup_roll.barrel_diameter", "is smaller than the work roll",
               {"work_roll.barrel_diameter"});
  check_bearing_name("work_roll.bearing", stand.work_roll.bearing, bearing_names(stand), reading);
  check_bearing_name("backup_roll.bearing", stand.backup_roll.bearing, bearing_names(stand), reading);
  check_oil_films_of_stand(stand, reading);
  check_strip(stand.strip, reading);
  if (reading.usable({"strip.width", "work_roll.barrel_length"}) &&
      stand.strip.width > stand.work_roll.barrel_length)
    contradict(reading, "strip.width", "is wider than the barrel of the work roll", {"work_roll.barrel_length"});
  const double facing = std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length);
  if (reading.usable({"work_roll.axial_shift", "work_roll.barrel_length", "backup_roll.barrel_length"}) &&
      std::abs(stand.work_roll.axial_shift) > 0.4 * facing)
    contradict(
        reading, "work_roll.axial_shift",
        fmt::format("leaves too little of one barrel opposite the other; it may be at most 0.4 of the shorter "
                    "barrel, {}",
                    millimetres(0.4 * facing)),
        {"work_roll.barrel_length", "backup_roll.barrel_length"});
  for (const auto &[name, contact] :
       {std::pair("contact.upper", &stand.upper_contact), std::pair("contact.lower", &stand.lower_contact)})
    if (const std::string key = std::string(name) + ".load_offset";
        reading.usable({key, "work_roll.barrel_length", "backup_roll.barrel_length"}) &&
        std::abs(contact->load_offset) >= 0.5 * facing)
      contradict(reading, key,
                 fmt::format("puts the force outside the contact, which ends at {}", millimetres(0.5 * facing)),
                 {"work_roll.barrel_length", "backup_roll.barrel_length"});
  if (stand.passes.empty() && reading.usable({"pass"}))
    reading.add(Place{reading.file},
                "no [[pass]] is given; the working load of every stiffness comes from a pass");
  check_passes_in_bite(stand.passes, stand.strip, reading);
  check_bite_setup(stand.bite, stand.strip.friction, reading);
  check_fit(stand.bite, stand.strip, stand.passes, reading);
  for (std::size_t i = 0; i < stand.passes.size(); ++i)
    for (const auto &[name, contact] :
         {std::pair("contact.upper", &stand.upper_contact), std::pair("contact.lower", &stand.lower_contact)})
      if (const std::string loads = std::string(name) + ".loads";
          stand.passes[i].load < contact->loads[0] || stand.passes[i].load > contact->loads[1])
        contradict(reading, fmt::format("pass.{}.load", i),
                   fmt::format("is outside {}; change one of the two", reading.as_written(loads)), {loads});
  check_published_force(stand.dynamics, stand.given, reading);
  check_contact_curves(stand, reading);
  check_consistency(stand, reading);
}
}  // namespace mill
