#include "core/model/stack_case.h"
#include "core/case/kinds.h"
#include "core/case/section_list.h"
#include "core/case/stack_half.h"
#include "core/case/stack_resolution.h"
#include "core/case/stack_rows.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
StackSaddles read_saddles(const Node &roll, const std::string &key, Reading &reading)
{
  StackSaddles saddles;
  const Node::Entry *entry = roll.find("saddles");
  if (!entry)
    return saddles;
  if (entry->value.kind != Node::Kind::table) {
    reading.add(entry->value.place,
                fmt::format("{} = {} is a value; a section [roll.saddles] is needed", key, shown(entry->value)));
    return saddles;
  }
  read_and_echo(Section{&entry->value, key}, "[roll.saddles]", stack_saddle_rows(), saddles, reading);
  saddles.given = true;
  return saddles;
}

std::vector<StackRollInput> read_stack_rolls(const Node &root, Reading &reading)
{
  std::vector<StackRollInput> rolls;
  const Node::Entry *entry = root.find("roll");
  if (!entry || entry->value.kind != Node::Kind::array) {
    reading.add(entry ? entry->key_place : Place{reading.file},
                "no [[roll]] is given; a roll is written under [[roll]], in double brackets, one for each");
    return rolls;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const Node &node       = entry->value.items[i];
    const std::string name = fmt::format("roll.{}", i);
    if (node.kind != Node::Kind::table) {
      reading.add(node.place, fmt::format("{} = {} is a value; a section [[roll]] is needed", name, shown(node)));
      continue;
    }
    StackRollInput roll;
    read_and_echo(Section{&node, name}, "[[roll]]", stack_roll_rows(), roll, reading, {"saddles"});
    roll.place   = node.place;
    roll.saddles = read_saddles(node, name + ".saddles", reading);
    rolls.push_back(std::move(roll));
  }
  return rolls;
}

std::vector<StackMaterial> read_materials(const Node &root, Reading &reading)
{
  std::vector<StackMaterial> materials;
  const Node::Entry *all = root.find("material");
  if (!all || all->value.kind != Node::Kind::table)
    return materials;
  for (const Node::Entry &entry : all->value.entries) {
    const std::string name = "material." + entry.key;
    if (entry.value.kind != Node::Kind::table) {
      reading.add(entry.value.place,
                  fmt::format("{} = {} is a value; a section [{}] is needed", name, shown(entry.value), name));
      continue;
    }
    StackMaterial material;
    read_and_echo(Section{&entry.value, name}, "[" + name + "]", stack_material_rows(), material, reading);
    material.name = entry.key;
    materials.push_back(material);
  }
  return materials;
}

bool is_in_case(const Reading &reading, const std::string &key)
{
  return reading.places.count(key) > 0;
}

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

// A profile, bending or an eccentric can make the gap smaller than S before the strip presses.
bool closes_gap(const StackRollInput &roll)
{
  return roll.bending_force[0] != 0 || roll.bending_force[1] != 0 || !roll.saddles.eccentric.empty() ||
         roll.crown != 0 || roll.thermal_crown != 0 || !roll.crown_table.empty() ||
         !roll.crown_polynomial.empty() || !roll.thermal_crown_table.empty();
}

void check_stack_strip(const StackInput &input, Reading &reading)
{
  const StackStripInput &strip = input.strip;
  const bool closes            = std::any_of(input.rolls.begin(), input.rolls.end(), closes_gap);
  const auto given             = [&](const char *k) { return is_in_case(reading, std::string("strip.") + k); };
  const auto lacks = [&](const char *k) { return !given(k) && reading.usable({std::string("strip.") + k}); };
  if (given("force") && given("gap"))
    contradict(reading, "strip.force", "is given together with a gap; give one of the two", {"strip.gap"});
  if (lacks("force") && lacks("gap"))
    reading.add(reading.place("strip.width"),
                "[strip] has neither 'force' nor 'gap'; add for example force = \"976.2 kN\"");
  if (given("gap"))
    for (const char *key : {"exit_thickness", "contact_length"})
      if (lacks(key))
        contradict(reading, "strip.gap", fmt::format("needs {}: the force is that at which the strip has it", key),
                   {});
  if (given("gap") && given("exit_thickness") && strip.gap >= strip.exit_thickness && !closes &&
      reading.usable({"strip.gap", "strip.exit_thickness"}))
    contradict(reading, "strip.gap", "is not smaller than the exit thickness: the strip would press on nothing",
               {"strip.exit_thickness"});
  if (strip.law == StackStripLaw::modulus && lacks("modulus"))
    reading.add(reading.place(given("law") ? "strip.law" : "strip.width"),
                "[strip] has law = \"modulus\" and no 'modulus'; add for example modulus = \"300 MPa\", or law = "
                "\"uniform\"");
  if (given("tension_modulus") && strip.tension_modulus > 0 &&
      (lacks("exit_thickness") || lacks("entry_thickness")))
    contradict(reading, "strip.tension_modulus", "needs entry_thickness and exit_thickness", {});
  if (lacks("contact_length") && !given("gap") && (lacks("exit_thickness") || lacks("entry_thickness")))
    reading.add(reading.place("strip.width"),
                "[strip] has no 'contact_length', and no entry_thickness and exit_thickness from which it could "
                "follow; add for example contact_length = \"25 mm\"");
  if (given("entry_thickness") && given("exit_thickness") && strip.exit_thickness >= strip.entry_thickness)
    contradict(reading, "strip.exit_thickness", "is not smaller than the entry thickness",
               {"strip.entry_thickness"});
  if (strip.crown_at > strip.width / 2)
    contradict(reading, "strip.crown_at", "is beyond the middle of the strip", {"strip.width"});
  if (const double deepest = std::max(strip.edge_drop[0], strip.edge_drop[1]); deepest > strip.width / 2) {
    if (given("edge_drop"))
      contradict(reading, "strip.edge_drop", "is beyond the middle of the strip", {"strip.width"});
    else
      reading.add(reading.place("strip.width"),
                  fmt::format("the edge drop is read at {} from the edge, beyond the middle of the strip; add for "
                              "example edge_drop = [\"50 mm\", \"25 mm\"]",
                              millimetres(deepest)));
  }
}
}  // namespace

namespace {
// [strip], and what of it is a bite.
void read_stack_strip(const Node &root, StackInput &input, Reading &reading)
{
  StackStripInput &strip   = input.strip;
  const Section section    = section_at(root, "strip", reading);
  const Node::Entry *entry = section.node ? section.node->find("friction") : nullptr;
  const bool has_law       = entry && entry->value.kind == Node::Kind::table;
  auto rows                = stack_strip_rows();
  if (has_law)
    rows.pop_back();
  read_and_echo(section, section.header(), rows, strip, reading,
                has_law ? std::vector<std::string>{"flow_stress", "friction"}
                        : std::vector<std::string>{"flow_stress"});
  Strip &bite               = input.bite;
  bite.width                = strip.width;
  bite.entry_thickness      = strip.entry_thickness;
  bite.exit_thickness       = strip.exit_thickness;
  bite.entry_tension        = strip.entry_tension;
  bite.exit_tension         = strip.exit_tension;
  bite.initial_thickness    = strip.initial_thickness;
  bite.youngs_modulus       = strip.youngs_modulus;
  bite.poisson_ratio        = strip.poisson_ratio;
  bite.friction.coefficient = std::isnan(strip.coulomb) ? 0 : strip.coulomb;
  bite.flow_stress.k        = not_given;
  if (section.node && section.node->find("flow_stress")) {
    bite.flow_stress = read_flow_stress(root, reading);
    check_flow_and_friction(bite, reading);
  }
  if (has_law)
    bite.friction = read_friction_law({&entry->value, "strip.friction"}, reading);
}

// law = "bite" takes its slopes from a bite.
void check_law_of_bite(const StackInput &input, Reading &reading)
{
  if (input.strip.law != StackStripLaw::bite || !reading.usable({"strip.law"}))
    return;
  const auto given   = [&](const char *k) { return is_in_case(reading, std::string("strip.") + k); };
  const Strip &strip = input.bite;
  const bool rubs    = strip.friction.law != FrictionLaw::coulomb || strip.friction.coefficient > 0;
  if (std::isnan(strip.flow_stress.k) && reading.usable({"strip.flow_stress.law"}))
    contradict(reading, "strip.law",
               "needs the flow stress of the strip; add for example [strip.flow_stress] with law = \"constant\" "
               "and k = \"300 MPa\"",
               {});
  if (!rubs && reading.usable({"strip.friction"}))
    contradict(reading, "strip.law", "needs the friction in the bite; add for example friction = 0.05 to [strip]",
               {});
  for (const char *key : {"entry_thickness", "exit_thickness"})
    if (!given(key) && reading.usable({std::string("strip.") + key}))
      contradict(reading, "strip.law", fmt::format("needs {} of the strip", key), {});
  for (const char *key : {"modulus", "entry_modulus", "tension_modulus"})
    if (given(key))
      doubt(reading, std::string("strip.") + key,
            {"is not used", "with law = \"bite\" it follows from the bite", ""}, {"strip.law"});
}

// Pairs of ranges that make a map, and the rolls that they name.
void check_window(const StackInput &input, Reading &reading)
{
  const StackWindow &window = input.window;
  const auto given          = [&](const char *k) { return is_in_case(reading, std::string("window.") + k); };
  const auto ranges         = {std::pair{"bending_force", &window.bending},
                               {"shift", &window.shift},
                               {"force", &window.force},
                               {"width", &window.width}};
  for (const auto &[key, range] : ranges)
    if (given(key) && !((*range)[0] < (*range)[1]))
      contradict(reading, std::string("window.") + key, "does not increase; write the smaller value first", {});
  const auto needs = [&](const char *key, const char *other) {
    if (given(key) && !given(other) && reading.usable({std::string("window.") + other}))
      contradict(reading, std::string("window.") + key,
                 fmt::format("needs {} as well, the other side of the map", other), {});
  };
  for (const auto &[one, other] : {std::pair{"bending_force", "shift"},
                                   {"bending_force", "bent"},
                                   {"shift", "shifted"},
                                   {"force", "width"}}) {
    needs(one, other);
    needs(other, one);
  }
  if (given("shift") && input.settings.bending_at == BendingAt::window)
    contradict(reading, "window.shift", "is not computed while bending forces stay in the window; remove it",
               {"stack.bending_at"});
  const StackStripInput &strip = input.strip;
  const double deepest         = std::max({strip.crown_at, strip.edge_drop[0], strip.edge_drop[1]});
  if (given("width") && window.width[0] / 2 < deepest && strip.width / 2 >= deepest &&
      reading.usable({"window.width", "strip.crown_at", "strip.edge_drop"}))
    contradict(
        reading, "window.width",
        fmt::format("begins with a strip on which {} from the edge is beyond its middle, where the crown or "
                    "the edge drop is read; begin with {} or more",
                    millimetres(deepest), millimetres(2 * deepest)),
        {strip.crown_at == deepest ? "strip.crown_at" : "strip.edge_drop"});
  std::vector<std::string> names;
  for (const StackRollInput &roll : input.rolls)
    names.push_back(roll.name);
  for (const auto &[key, name] : {std::pair{"bent", &window.bent}, {"shifted", &window.shifted}})
    if (given(key) && std::find(names.begin(), names.end(), *name) == names.end())
      contradict(reading, std::string("window.") + key, "names no roll" + suggestion(*name, names), {});
    else if (given(key) && key == std::string("bent"))
      for (std::size_t r = 0; r < names.size(); ++r)
        if (names[r] == *name && std::isnan(input.rolls[r].bearing_span))
          contradict(reading, "window.bent", "names a roll without bearing_span, which no chock bends", {});
}

// A pass without a force is rolled with that of the strip.
void check_stack_passes(const StackInput &input, Reading &reading)
{
  std::vector<Pass> passes = input.passes;
  for (Pass &pass : passes)
    if (pass.force_file.empty() && std::isnan(pass.load))
      pass.load = 1;
  check_passes(passes, reading);
}
}  // namespace

StackCase read_stack(const Node &root, Reading &reading)
{
  auto input           = std::make_shared<StackInput>();
  const auto read_once = [&](const char *name, const auto &rows, auto &out) {
    const Section section = section_at(root, name, reading);
    read_and_echo(section, section.header(), rows, out, reading);
  };
  read_once("steel", steel_rows(), input->steel);
  read_once("stack", stack_settings_rows(), input->settings);
  input->materials = read_materials(root, reading);
  input->rolls     = read_stack_rolls(root, reading);
  std::string carries;  // of a roll whose chock carries the force: its support is that of a backup roll
  for (const StackRollInput &roll : input->rolls)
    carries = carries.empty() ? roll.bearing : carries;
  input->bearings = read_bearings(root, carries, reading);
  read_stack_strip(root, *input, reading);
  read_once("engine", stack_engine_rows(), input->engine);
  read_once("window", stack_window_rows(), input->window);
  input->passes   = read_passes(root, pass_rows(), reading);
  input->dynamics = read_dynamics(root, stack_dynamics_rows(), reading);
  input->span     = read_stand_span(root, reading);
  input->analysis = read_chatter_analysis(root, reading);
  check_stack_rolls(*input, root, reading);
  check_stack_strip(*input, reading);
  check_law_of_bite(*input, reading);
  check_window(*input, reading);
  check_stack_passes(*input, reading);
  auto stack = std::make_shared<Stack>();
  if (reading.problems.empty())
    *stack = resolved_stack(*input, reading);
  return {input, stack};
}
}  // namespace mill
