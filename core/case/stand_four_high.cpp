#include "core/case/stand_reader.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
WorkRollInput read_work_roll(const Node &root, Reading &reading)
{
  WorkRollInput roll;
  const Section section = section_at(root, "work_roll", reading);
  read_and_echo(section, section.header(), work_roll_rows(), roll, reading);
  roll.neck_length = (roll.total_length - roll.barrel_length) / 2;
  check_work_roll(roll, reading);
  return roll;
}

Roll read_backup_roll(const Node &root, Reading &reading)
{
  Roll roll;
  const Section section = section_at(root, "backup_roll", reading);
  read_and_echo(section, section.header(), backup_roll_rows(), roll, reading);
  check_backup_roll(roll, reading);
  return roll;
}

ContactSettings read_roll_contact(const Node &root, const std::string &name, Reading &reading)
{
  ContactSettings contact;
  const Section section = section_at(root, name, reading);
  read_and_echo(section, section.header(), roll_contact_rows(), contact, reading);
  contact.loads_place    = reading.place(name + ".loads");
  contact.elements_place = reading.place(name + ".elements_per_half_width");
  check_contact(name, contact, reading);
  return contact;
}
}  // namespace

FourHigh read_four_high(const Node &root, Reading &reading)
{
  FourHigh stand;
  const Section steel = section_at(root, "steel", reading);
  read_and_echo(steel, steel.header(), steel_rows(), stand.steel, reading);
  stand.work_roll   = read_work_roll(root, reading);
  stand.backup_roll = read_backup_roll(root, reading);
  stand.bearings    = read_bearings(root, stand.backup_roll.bearing, reading);
  stand.housing     = read_housing(root, stand.steel, reading);
  stand.screwdown   = read_screwdown(root, reading);
  const bool drawn  = section_at(root, "housing", reading).node != nullptr;
  const auto backup = std::find_if(stand.bearings.begin(), stand.bearings.end(),
                                   [&](const RollerBearing &b) { return b.name == stand.backup_roll.bearing; });
  const bool known  = backup != stand.bearings.end();
  stand.frame = read_frame(root, frame_keys_behind(drawn, stand.screwdown, known ? &*backup : nullptr), reading);
  if (known)
    drop_counted_chocks(stand.frame, *backup, reading);
  stand.strip  = read_strip(root, reading);
  stand.passes = read_passes(root, pass_rows(), reading);
  check_passes(stand.passes, reading);
  if (const Section contact = section_at(root, "contact", reading); contact.node)
    refuse_unknown_keys(contact, {}, {"upper", "lower"}, reading);
  stand.upper_contact = read_roll_contact(root, "contact.upper", reading);
  stand.lower_contact = read_roll_contact(root, "contact.lower", reading);
  stand.bite          = read_bite_setup(root, reading);
  stand.dynamics      = read_dynamics(root, dynamics_rows(), reading);
  stand.span          = read_stand_span(root, reading);
  stand.analysis      = read_chatter_analysis(root, reading);
  stand.given         = read_given(root, "given", "four-high", reading);
  stand.published     = read_given(root, "published", "four-high", reading);
  check_four_high(stand, reading);
  return stand;
}

Lumped read_lumped(const Node &root, Reading &reading)
{
  Lumped lumped;
  lumped.given  = read_given(root, "given", "lumped", reading);
  lumped.passes = read_passes(root, pass_rows(), reading);
  check_passes(lumped.passes, reading);
  lumped.dynamics = read_dynamics(root, chain_dynamics_rows(), reading);
  check_published_force(lumped.dynamics, lumped.given, reading);
  return lumped;
}

TwoCylinders read_two_cylinders(const Node &root, Reading &reading)
{
  TwoCylinders pair;
  const auto read_section = [&](const std::string &name, const auto &rows, auto &out) {
    const Section section = section_at(root, name, reading);
    read_and_echo(section, section.header(), rows, out, reading);
  };
  read_section("steel", steel_rows(), pair.steel);
  read_section("upper", upper_cylinder_rows(), pair);
  read_section("lower", lower_cylinder_rows(), pair);
  if (const Section contact = section_at(root, "contact", reading); contact.node)
    refuse_unknown_keys(contact, {}, {"line"}, reading);
  read_section("contact.line", line_contact_rows(), pair.contact);
  pair.contact.loads_place    = reading.place("contact.line.loads");
  pair.contact.elements_place = reading.place("contact.line.elements_per_half_width");
  check_contact("contact.line", pair.contact, reading);
  return pair;
}
}  // namespace mill
