#include "core/case/stand_reader.h"
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mill {
namespace {
template <class Law, class Rows> std::vector<std::string> keys_of(const Law &law, const Rows &constants)
{
  std::vector<std::string> keys;
  for (const auto member : row_of(law.law).needs)
    for (const auto &constant : constants)
      if (constant.member == member)
        keys.push_back(constant.key);
  return keys;
}

std::vector<std::string> keys_needed(const FlowStress &flow)
{
  return row_of(flow.law).tabled ? std::vector<std::string>{"table"} : keys_of(flow, flow_stress_constants());
}

std::vector<std::string> keys_needed(const Friction &friction)
{
  return keys_of(friction, friction_constants());
}

// Every key that a law cannot do without.
template <class Law> void check_law(const std::string &section, const Law &law, Reading &reading)
{
  for (const std::string &key : keys_needed(law))
    if (!reading.places.count(section + key) && !reading.bad.count(section + key))
      contradict(reading, section + "law", fmt::format("needs '{}'", key), {});
}

// @param key  full, "strip.entry_tension" or "pass.0.entry_tension"
void check_tension(const std::string &key, const double tension, const Strip &strip, Reading &reading)
{
  const double limit    = initial_stress(strip.flow_stress);
  const std::string law = row_of(strip.flow_stress.law).tabled ? "table" : "k";
  if (reading.usable({key, "strip.flow_stress.k", "strip.flow_stress.law", "strip.flow_stress.table"}) &&
      limit > 0 && tension >= limit)
    contradict(reading, key,
               fmt::format("would stretch the strip outside the bite, whose flow stress is {:.6g} MPa there",
                           limit / 1e6),
               {"strip.flow_stress." + law});
}

}  // namespace

void check_flow_and_friction(const Strip &strip, Reading &reading)
{
  if (reading.usable({"strip.flow_stress.law"}))
    check_law("strip.flow_stress.", strip.flow_stress, reading);
  if (reading.places.count("strip.friction.law"))  // else a number, or refused
    check_law("strip.friction.", strip.friction, reading);
}

void check_strip(const Strip &strip, Reading &reading)
{
  if (reading.usable({"strip.entry_thickness", "strip.exit_thickness"}) &&
      strip.exit_thickness >= strip.entry_thickness)
    contradict(reading, "strip.exit_thickness", "is not smaller than the entry thickness",
               {"strip.entry_thickness"});
  if (reading.usable({"strip.entry_thickness", "strip.initial_thickness"}) &&
      strip.initial_thickness < strip.entry_thickness)
    contradict(reading, "strip.initial_thickness", "is smaller than the entry thickness",
               {"strip.entry_thickness"});
  check_flow_and_friction(strip, reading);
  check_tension("strip.entry_tension", strip.entry_tension, strip, reading);
  if (!hardens(strip.flow_stress))  // a hardening strip is stronger behind the bite
    check_tension("strip.exit_tension", strip.exit_tension, strip, reading);
}

void check_not_empty(const std::string &key, const std::string &name, Reading &reading)
{
  if (name.find_first_not_of(" \t") == std::string::npos)
    contradict(reading, key, "is empty; it names results and files", {});
}

void check_pass_names(const std::vector<Pass> &passes, Reading &reading)
{
  std::map<std::string, std::size_t> first;  // pass that has a name
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const auto key          = [](const std::size_t k) { return fmt::format("pass.{}.name", k); };
    const std::string &name = passes[i].name;
    if (!reading.usable({key(i)}))
      continue;
    check_not_empty(key(i), name, reading);
    if (const auto [earlier, is_new] = first.emplace(name, i); !is_new)
      contradict(reading, key(i), "is the name of an earlier pass as well", {key(earlier->second)});
  }
}

void check_passes_in_bite(const std::vector<Pass> &passes, const Strip &strip, Reading &reading)
{
  const bool by_speed = needs_speed(strip.friction);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const Pass &pass     = passes[i];
    const auto key       = [&](const char *k) { return fmt::format("pass.{}.{}", i, k); };
    const bool own_entry = !std::isnan(pass.entry_thickness), own_exit = !std::isnan(pass.exit_thickness);
    const std::string entry_key = own_entry ? key("entry_thickness") : "strip.entry_thickness";
    const std::string exit_key  = own_exit ? key("exit_thickness") : "strip.exit_thickness";
    const double entry          = own_entry ? pass.entry_thickness : strip.entry_thickness;
    const double exit           = own_exit ? pass.exit_thickness : strip.exit_thickness;
    if ((own_entry || own_exit) && reading.usable({entry_key, exit_key}) && exit >= entry)
      contradict(reading, own_exit ? exit_key : entry_key, "leaves no reduction between entry and exit thickness",
                 {own_exit ? entry_key : exit_key});
    if (!std::isnan(pass.entry_tension))
      check_tension(key("entry_tension"), pass.entry_tension, strip, reading);
    if (!std::isnan(pass.exit_tension) && !hardens(strip.flow_stress))
      check_tension(key("exit_tension"), pass.exit_tension, strip, reading);
    if (by_speed && std::isnan(pass.speed) && reading.usable({key("speed")}))
      contradict(
          reading, "strip.friction.law",
          fmt::format("needs the speed of the rolls, which pass \"{}\" does not give; add for example speed = "
                      "\"2 m/s\" to it",
                      pass.name),
          {key("name")});
  }
}

void check_bite_setup(const BiteSetup &setup, const Friction &friction, Reading &reading)
{
  if (reading.usable({"bite.theory"}) && setup.theory == SlabTheory::hu_ehmann && slides(friction))
    contradict(reading, "bite.theory", "is a theory of friction factors; set strip.friction.law = \"factor\"",
               {"strip.friction", "strip.friction.law"});
  if (reading.usable({"bite.theory"}) && setup.theory == SlabTheory::bland_ford && !slides(friction))
    contradict(reading, "bite.theory", "does not accept friction factors; choose karman, orowan or hu-ehmann",
               {"strip.friction.law"});
  if (reading.usable({"bite.strip", "bite.arc"}) && setup.strip == BiteStrip::elastic_plastic &&
      setup.arc == BiteArc::hitchcock)
    contradict(reading, "bite.strip",
               "is solved on a rigid roll or on a free arc; set arc = \"elastic\" or \"rigid\"", {"bite.arc"});
  if (reading.usable({"bite.theory", "bite.arc"}) && setup.arc == BiteArc::elastic &&
      setup.theory != SlabTheory::karman)
    contradict(reading, "bite.arc", "is solved with the theory karman only", {"bite.theory"});
}
}  // namespace mill
