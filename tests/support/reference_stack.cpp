#include "tests/support/reference_stack.h"
#include <map>

namespace {
constexpr double mm = 1e-3, um = 1e-6, per_mm = 1e3, MPa = 1e6;

void take_profile(mill::StackRoll &roll, const Reference &written)
{
  roll.profile.barrel_length = roll.length;
  if (!written.contains("profile_diameter_um"))
    return;
  const Reference profile = written["profile_diameter_um"];
  if (profile.contains("crown"))
    roll.profile.crown = um * double(profile["crown"]);
  if (profile.contains("polynomial"))
    for (const Reference term : profile["polynomial"])
      roll.profile.crown_polynomial.push_back({double(term[0]), um * double(term[1])});
  if (profile.contains("table"))
    for (const Reference point : profile["table"])
      roll.profile.crown_table.push_back({mm * double(point[0]), um * double(point[1])});
}

mill::StackRoll take_roll(const std::string &name, const Reference &written)
{
  mill::StackRoll roll;
  roll.name     = name;
  roll.diameter = mm * double(written["D"]);
  roll.length   = mm * double(written["L"]);
  roll.axis     = {mm * double(written["x"]), mm * double(written["y"])};
  roll.shift    = mm * double(written["shift"]);
  roll.material = {MPa * double(written["E"]), written["nu"], written["rho_kg_m3"], mill::not_given};
  for (const Reference s : written["sections"])
    roll.sections.push_back({mm * double(s[0]), mm * double(s[1]), mm * double(s[2])});
  for (const Reference s : written["supports_z_kx_ky_ex_ey"])
    roll.supports.push_back({mm * double(s[0]),
                             {per_mm * double(s[1]), per_mm * double(s[2])},
                             {mm * double(s[3]), mm * double(s[4])}});
  for (const Reference l : written["loads_z_fx_fy"])
    roll.loads.push_back({mm * double(l[0]), {double(l[1]), double(l[2])}});
  for (const Reference l : written["lumps_z_kg"])
    roll.lumps.push_back({mm * double(l[0]), double(l[1])});
  take_profile(roll, written);
  return roll;
}

// The rolls whose axes are next to the pass line, y = 0.
void find_work_rolls(mill::Stack &stack)
{
  const auto y = [&](const std::size_t r) { return stack.rolls[r].axis[1]; };
  for (std::size_t r = 0; r < stack.rolls.size(); ++r) {
    if (y(r) > 0 && (y(stack.upper) < 0 || y(r) < y(stack.upper)))
      stack.upper = r;
    if (y(r) < 0 && (y(stack.lower) > 0 || y(r) > y(stack.lower)))
      stack.lower = r;
  }
}
}  // namespace

mill::Stack reference_stack(const Reference &entry)
{
  mill::Stack stack;
  std::map<std::string, std::size_t> place;
  const Reference input = entry["input"];
  for (const auto &[name, roll] : input["rolls"].items()) {
    place[name] = stack.rolls.size();
    stack.rolls.push_back(take_roll(name, roll));
  }
  find_work_rolls(stack);
  for (const Reference written : input["contacts"]) {
    mill::StackContact contact{place.at(written["a"]), place.at(written["b"]), {}, mill::not_given};
    if (written.contains("k_extra_MPa") && !written["k_extra_MPa"].empty())
      contact.ring_stiffness = MPa * double(written["k_extra_MPa"]);
    for (const Reference zone : written["zones"])
      contact.zones.push_back({mm * double(zone[0]), mm * double(zone[1])});
    stack.contacts.push_back(std::move(contact));
  }
  const Reference strip       = input["strip"];
  stack.strip.width           = mm * double(strip["width_mm"]);
  stack.strip.offset          = mm * double(strip["offset_mm"]);
  stack.strip.force           = strip["F_N"];
  stack.strip.modulus         = MPa * double(strip["k_h_N_per_mm2"]);
  stack.strip.entry_modulus   = stack.strip.modulus;
  stack.strip.tension_modulus = MPa * double(strip["k_tension_N_per_mm2"]);
  stack.strip.arc             = mm * double(strip["arc_mm"]);
  stack.strip.entry_thickness = mm * double(strip["H_mm"]);
  stack.strip.exit_thickness  = mm * double(strip["h_mm"]);
  return stack;
}
