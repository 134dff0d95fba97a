#include "core/case/stand_reader.h"
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mill {
namespace {
// Initial value of the flow stress, where the law has one of its own; the strip must carry its back tension there.
double initial_stress(const FlowStress &flow)
{
  if (flow.law == "constant")
    return flow.k;
  if (flow.law == "swift" || flow.law == "reduction-power")
    return flow.k * std::pow(flow.eps0, flow.n);
  if (flow.law == "ludwik" || flow.law == "voce")
    return flow.k0;
  if (flow.law == "table" && !flow.table.empty())
    return flow.table.front()[1];
  return not_given;
}

void check_flow_stress(const FlowStress &flow, Reading &reading)
{
  const std::string name = "strip.flow_stress.";
  const auto needs       = [&](const char *key) {
    if (!reading.places.count(name + key) && !reading.bad.count(name + key))
      contradict(reading, name + "law", fmt::format("needs '{}'", key), {});
  };
  if (!reading.usable({name + "law"}))
    return;
  if (flow.law == "table")
    needs("table");
  else
    needs("k");
  if (flow.law == "ludwik" || flow.law == "voce")
    needs("k0");
  if (flow.law == "swift" || flow.law == "reduction-power")
    needs("eps0");
  if (flow.law != "constant" && flow.law != "table")
    needs("n");
}

// @param key  full, "strip.entry_tension" or "pass.0.entry_tension"
void check_tension(const std::string &key, const double tension, const Strip &strip, Reading &reading)
{
  const double limit    = initial_stress(strip.flow_stress);
  const std::string law = strip.flow_stress.law == "table" ? "table" : "k";
  if (reading.usable({key, "strip.flow_stress.k", "strip.flow_stress.law", "strip.flow_stress.table"}) &&
      limit > 0 && tension >= limit)
    contradict(reading, key,
               fmt::format("would stretch the strip outside the bite, whose flow stress is {:.6g} MPa there",
                           limit / 1e6),
               {"strip.flow_stress." + law});
}

// Keys a friction law cannot do without.
void check_friction(const Friction &friction, Reading &reading)
{
  const std::string name = "strip.friction.";
  if (!reading.places.count(name + "law"))
    return;  // a number, or refused
  const auto needs = [&](const char *key) {
    if (!reading.places.count(name + key) && !reading.bad.count(name + key))
      contradict(reading, name + "law", fmt::format("needs '{}'", key), {});
  };
  if (friction.law == "coulomb")
    needs("coefficient");
  if (friction.law == "factor")
    for (const char *key : {"entry_factor", "exit_factor"})
      needs(key);
  if (friction.law == "speed")
    needs("at_unit_speed");
  if (friction.law == "film")
    for (const char *key : {"mu0", "mu1", "decay", "viscosity", "pressure_viscosity"})
      needs(key);
}
}  // namespace

void check_flow_and_friction(const Strip &strip, Reading &reading)
{
  check_flow_stress(strip.flow_stress, reading);
  check_friction(strip.friction, reading);
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
  if (strip.flow_stress.law == "constant")  // a hardening strip is stronger behind the bite
    check_tension("strip.exit_tension", strip.exit_tension, strip, reading);
}

void check_names_a_file(const std::string &key, const std::string &name, Reading &reading)
{
  if (name.empty() || name.find('/') != std::string::npos || name[0] == '.')
    contradict(reading, key, "cannot name a file; it may not be empty, begin with a dot or contain '/'", {});
}

void check_pass_names(const std::vector<Pass> &passes, Reading &reading)
{
  std::map<std::string, std::size_t> first;  // pass that has a name
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const auto key          = [](const std::size_t k) { return fmt::format("pass.{}.name", k); };
    const std::string &name = passes[i].name;
    if (!reading.usable({key(i)}))
      continue;
    check_names_a_file(key(i), name, reading);
    if (const auto [earlier, is_new] = first.emplace(name, i); !is_new)
      contradict(reading, key(i), "is the name of an earlier pass as well", {key(earlier->second)});
  }
  for (const auto &[name, i] : first)  // results of "a.fe" and of the model fe of "a" would have one name
    for (auto dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1))
      if (const auto other = first.find(name.substr(0, dot)); other != first.end())
        contradict(reading, fmt::format("pass.{}.name", i),
                   "continues the name of another pass after a dot, which parts the names of results; take a dash",
                   {fmt::format("pass.{}.name", other->second)});
}

void check_passes_in_bite(const std::vector<Pass> &passes, const Strip &strip, Reading &reading)
{
  const bool by_speed = strip.friction.law == "speed" || strip.friction.law == "film";
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
    if (!std::isnan(pass.exit_tension) && strip.flow_stress.law == "constant")
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
  if (reading.usable({"bite.theory"}) && setup.theory == "hu-ehmann" && friction.law != "factor")
    contradict(reading, "bite.theory", "is a theory of friction factors; give strip.friction a law of factors",
               {"strip.friction", "strip.friction.law"});
  if (reading.usable({"bite.theory"}) && setup.theory == "bland-ford" && friction.law == "factor")
    contradict(reading, "bite.theory", "knows no friction factors; choose karman, orowan or hu-ehmann",
               {"strip.friction.law"});
  if (reading.usable({"bite.strip", "bite.arc"}) && setup.strip == "elastic-plastic" && setup.arc == "hitchcock")
    contradict(reading, "bite.strip",
               "is solved on a rigid roll or on a free arc; set arc = \"elastic\" or \"rigid\"", {"bite.arc"});
  if (reading.usable({"bite.theory", "bite.arc"}) && setup.arc == "elastic" && setup.theory != "karman")
    contradict(reading, "bite.arc", "is solved with the theory karman only", {"bite.theory"});
}
}  // namespace mill
