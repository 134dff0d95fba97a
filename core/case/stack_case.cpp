#include "core/model/stack_case.h"
#include "core/case/kinds.h"
#include "core/case/section_list.h"
#include "core/case/stack_half.h"
#include "core/case/stack_resolution.h"
#include "core/case/stack_roll_checks.h"
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
