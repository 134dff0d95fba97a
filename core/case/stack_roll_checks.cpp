#include "core/case/stack_roll_checks.h"
#include "core/case/kinds.h"
#include "core/case/section_list.h"
#include "core/case/stack_half.h"
#include "core/case/stack_rows.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
void check_roll_names(const StackInput &input, Reading &reading)
{
  for (std::size_t r = 0; r < input.rolls.size(); ++r) {
    const std::string &name = input.rolls[r].name;
    const bool good         = !name.empty() && std::all_of(name.begin(), name.end(), [](const unsigned char c) {
      return std::isalnum(c) || c == '_';
    });
    if (!good && reading.usable({roll_key(r, "name")}))
      contradict(reading, roll_key(r, "name"), "is not a name of a roll; use letters, digits and _", {});
    for (std::size_t other = 0; other < r; ++other)
      if (!name.empty() && input.rolls[other].name == name)
        contradict(reading, roll_key(r, "name"), "appears twice", {roll_key(other, "name")});
  }
}

// What a barrel is beyond the end of its table is not known.
void check_table_length(const StackRollInput &roll, const std::size_t r, Reading &reading)
{
  for (const auto &[name, table] :
       {std::pair{"crown_table", &roll.crown_table}, {"thermal_crown_table", &roll.thermal_crown_table}}) {
    if (table->empty() || !reading.usable({roll_key(r, name)}))
      continue;
    const double shortest = std::min(-table->front()[0], table->back()[0]), barrel = roll.barrel_length / 2;
    if (shortest < barrel * (1 - 1e-9))
      contradict(reading, roll_key(r, name),
                 fmt::format("ends at {} from mid-length, and the barrel at {}; add the points at both ends",
                             millimetres(shortest), millimetres(barrel)),
                 {roll_key(r, "barrel_length")});
  }
}

void check_shaft(const StackRollInput &roll, const std::size_t r, Reading &reading)
{
  const auto key   = [&](const char *k) { return roll_key(r, k); };
  const auto given = [&](const char *k) { return is_in_case(reading, key(k)); };
  if (given("sections") && (given("neck_diameter") || given("total_length")))
    contradict(reading, key("sections"),
               "is given together with a neck; give either sections, or neck_diameter and total_length",
               {key(given("neck_diameter") ? "neck_diameter" : "total_length")});
  else if (given("neck_diameter") != given("total_length"))
    contradict(reading, key(given("neck_diameter") ? "neck_diameter" : "total_length"),
               fmt::format("is given without {}; a neck needs both",
                           given("neck_diameter") ? "total_length" : "neck_diameter"),
               {});
  if (given("total_length") && roll.total_length <= roll.barrel_length)
    contradict(reading, key("total_length"), "is not longer than the barrel", {key("barrel_length")});
  for (std::size_t i = 0; i < roll.shaft.size(); ++i)
    if (roll.shaft[i][1] <= roll.shaft[i][0] ||
        (i > 0 && std::abs(roll.shaft[i][0] - roll.shaft[i - 1][1]) > 1e-9)) {
      contradict(
          reading, key("sections"),
          fmt::format("has a piece {} that does not begin where the one before it ends, or has no length; write "
                      "the pieces from the operator to the drive side",
                      i + 1),
          {});
      break;
    }
  if (const double barrel = roll.barrel_length / 2;
      given("sections") && !roll.shaft.empty() && !roll.saddles.given &&
      std::min(-roll.shaft.front()[0], roll.shaft.back()[1]) < barrel - 1e-9)
    contradict(
        reading, key("sections"),
        fmt::format("reaches from {} to {}, and the barrel to {} on both sides; write pieces up to its ends",
                    millimetres(roll.shaft.front()[0]), millimetres(roll.shaft.back()[1]), millimetres(barrel)),
        {key("barrel_length")});
}

// Bearings, chocks and bending act on the span; saddles replace the bearings.
void check_holding(const StackRollInput &roll, const std::size_t r, const bool listed, Reading &reading)
{
  const auto key                = [&](const char *k) { return roll_key(r, k); };
  const auto given              = [&](const char *k) { return is_in_case(reading, key(k)); };
  const std::string span_remedy = "; add for example bearing_span = \"2000 mm\"";
  if (!given("bearing_span") && reading.usable({key("bearing_span")}))
    for (const char *needing : {"bending_force", "bearing_stiffness", "bearing", "chock_mass"})
      if (given(needing)) {
        contradict(reading, key(needing), "needs the place where it acts" + span_remedy, {});
        return;
      }
  if (!given("bearing_span") && roll.on.empty() && !roll.saddles.given && reading.usable({key("on")}))
    reading.add(
        roll.place,
        fmt::format("roll {} leans on none and nothing carries it; name the rolls that it leans on in 'on', "
                    "give bearing_span for its bearings, or a section [roll.saddles]",
                    roll.name));
  if (given("bearing_span") && roll.bearing_span <= roll.barrel_length)
    contradict(
        reading, key("bearing_span"),
        fmt::format("puts the bearings inside the barrel, which is {} long", millimetres(roll.barrel_length)),
        {key("barrel_length")});
  if (given("bearing_span") && !roll.saddles.given) {
    const double end = given("sections")
                           ? std::min(-roll.shaft.front()[0], roll.shaft.back()[1])
                           : (std::isnan(roll.total_length) ? roll.barrel_length : roll.total_length) / 2;
    if (roll.bearing_span / 2 > end * (1 + 1e-9))
      contradict(reading, key("bearing_span"),
                 fmt::format("puts the bearings beyond the ends of the roll, which is {} long; give its necks by "
                             "neck_diameter and total_length, or sections",
                             millimetres(2 * end)),
                 {key("barrel_length")});
  }
  if (given("bearing_stiffness") && !roll.on.empty())
    contradict(reading, key("bearing_stiffness"),
               "belongs to a roll that leans on none; a roll that leans on others is carried by them, remove it",
               {key("on")});
  for (const auto &[name, values] : {std::pair{"bearing_stiffness", &roll.bearing_stiffness},
                                     {"housing_stiffness", &roll.housing_stiffness},
                                     {"chock_mass", &roll.chock_mass}})
    if (values->size() > (listed ? 1 : 2))
      contradict(reading, key(name),
                 listed ? "has more than one value; with lower = \"listed\" each roll has its own"
                        : "has more than two values; give one, or that of the upper and of the lower roll",
                 {});
}

std::vector<std::string> oil_films_of(const Node &root)
{
  std::vector<std::string> names;
  if (const Node::Entry *all = root.find("bearing"))
    for (const Node::Entry &entry : all->value.entries)
      if (is_oil_film(entry))
        names.push_back(entry.key);
  return names;
}

// A bearing of the case in place of the stiffness of the whole support.
void check_own_bearing(const StackRollInput &roll, const std::size_t r, const StackInput &input, const Node &root,
                       Reading &reading)
{
  const auto key   = [&](const char *k) { return roll_key(r, k); };
  const auto given = [&](const char *k) { return is_in_case(reading, key(k)); };
  if (given("housing_stiffness") && !given("bearing"))
    contradict(reading, key("housing_stiffness"),
               "belongs to a bearing; add for example bearing = \"crb\" with a section [bearing.crb], or give "
               "bearing_stiffness of bearing, chock and housing together",
               {});
  if (!given("bearing"))
    return;
  if (given("bearing_stiffness"))
    contradict(reading, key("bearing"), "is given together with bearing_stiffness; give one of the two",
               {key("bearing_stiffness")});
  if (roll.saddles.given)
    contradict(reading, key("bearing"), "is given together with saddles; give one of the two",
               {key("saddles.positions")});
  if (!roll.on.empty())
    contradict(reading, key("bearing"),
               "belongs to a roll that leans on none; a roll that leans on others is carried by them, remove it",
               {key("on")});
  const std::vector<std::string> films = oil_films_of(root);
  if (std::find(films.begin(), films.end(), roll.bearing) != films.end())
    contradict(
        reading, key("bearing"),
        "names an oil-film bearing; rolls of a stack take roller bearings. Give the stiffness of its film with "
        "chock and housing as bearing_stiffness, and remove the key",
        {});
  else
    check_bearing_name(key("bearing"), roll.bearing, names_in(input.bearings), reading);
}

void check_saddles(const StackRollInput &roll, const std::size_t r, Reading &reading)
{
  const StackSaddles &saddles = roll.saddles;
  const auto key              = [&](const char *k) { return roll_key(r, "saddles.") + k; };
  if (!saddles.given || !reading.usable({key("positions"), key("stiffness"), key("eccentric"), key("rings")}))
    return;
  const std::size_t n = saddles.positions.size();
  if (!roll.on.empty())
    contradict(reading, key("positions"), "belongs to a roll that leans on none", {roll_key(r, "on")});
  if (is_in_case(reading, roll_key(r, "bearing_span")))
    contradict(reading, roll_key(r, "bearing_span"), "is given together with saddles; give one of the two",
               {key("positions")});
  if (saddles.stiffness.size() != 1 && saddles.stiffness.size() != n)
    contradict(
        reading, key("stiffness"),
        fmt::format("has {} values for {} saddles; give one for all or one of each", saddles.stiffness.size(), n),
        {key("positions")});
  if (!saddles.eccentric.empty() && saddles.eccentric.size() != n)
    contradict(reading, key("eccentric"),
               fmt::format("has {} values for {} saddles; give one of each", saddles.eccentric.size(), n),
               {key("positions")});
  for (std::size_t i = 0; i < n; ++i)
    if ((i > 0 && saddles.positions[i] <= saddles.positions[i - 1]) ||
        std::abs(saddles.positions[i]) > roll.barrel_length / 2 * (1 + 1e-9)) {
      contradict(
          reading, key("positions"),
          fmt::format("has saddle {} not beyond the one before it, or beyond the end of the barrel at {}; write "
                      "them from the operator to the drive side",
                      i + 1, millimetres(roll.barrel_length / 2)),
          {roll_key(r, "barrel_length")});
      break;
    }
  for (std::size_t i = 0; i < saddles.rings.size(); ++i) {
    if (saddles.rings[i][1] <= saddles.rings[i][0] || (i > 0 && saddles.rings[i][0] < saddles.rings[i - 1][1])) {
      contradict(reading, key("rings"),
                 fmt::format("has ring {} that overlaps the one before it, or has no length; write from and to of "
                             "each, from the operator to the drive side",
                             i + 1),
                 {});
      break;
    }
  }
}
}  // namespace

void check_stack_rolls(const StackInput &input, const Node &root, Reading &reading)
{
  check_roll_names(input, reading);
  std::vector<std::string> materials;
  for (const StackMaterial &material : input.materials)
    materials.push_back(material.name);
  for (std::size_t r = 0; r < input.rolls.size(); ++r) {
    const StackRollInput &roll = input.rolls[r];
    if (!reading.usable({roll_key(r, "barrel_diameter"), roll_key(r, "barrel_length")}))
      continue;
    check_profile(fmt::format("roll.{}", r), roll, reading);
    check_table_length(roll, r, reading);
    check_shaft(roll, r, reading);
    check_holding(roll, r, input.settings.lower == LowerHalf::listed, reading);
    check_own_bearing(roll, r, input, root, reading);
    check_saddles(roll, r, reading);
    if (roll.on.size() > 2)
      contradict(reading, roll_key(r, "on"), "names more than two rolls; a roll leans on one or two", {});
    if (!roll.material.empty() && std::find(materials.begin(), materials.end(), roll.material) == materials.end())
      contradict(
          reading, roll_key(r, "material"),
          materials.empty()
              ? fmt::format("names a section that is missing; add [material.{0}], or remove the key for [steel]",
                            roll.material)
              : fmt::format("names no [material.{}]{}", roll.material, suggestion(roll.material, materials)),
          {});
  }
}
}  // namespace mill
