#include "core/records/stack_names.h"
#include "core/base/digits.h"
#include "core/records/result_words.h"
#include "report/results/names.h"
#include <map>

// The results of a run of kind "stack" in words, in the order in which a reader asks for them.
namespace mill::report {
namespace {
const std::map<std::string, std::string> stack_words{
    {"stack.force", "rolling force"},
    {"stack.crown", "crown of the strip, positive: thicker in the middle"},
    {"stack.edge_drop", "edge drop of the strip, mean of both sides"},
    {"stack.wedge", "wedge of the strip, drive less operator side"},
    {"stack.profile_rms", "root mean square of the exit thickness about its mean over the width"},
    {"stack.opening", "opening of the gap by the force, middle of the strip"},
    {"stack.gap", "gap between the unloaded work rolls"},
    {"stack.modulus.mid", "modulus of the stack, force per thickness in the middle"},
    {"stack.modulus.mean", "modulus of the stack, force per thickness that the line load weighs"},
    {"stack.strip_stiffness", "strip between the work rolls as a spring, with their flattening"},
    {"stack.flatness.min", "flatness in I-units, shortest fibre"},
    {"stack.flatness.max", "flatness in I-units, longest fibre"},
    {"pair.force", "force of the contact"},
    {"pair.load_centre", "place of its resultant along z"},
    {"pair.q_max", "largest line load"},
    {"pair.peak_pressure", "peak pressure of the contact"},
    {"pair.touching", "share of the length that touches"},
    {"pair.tangent", "change of the force over that of the approach that the line load weighs"},
    {"pair.uniform_tangent", "tangent of the contact for an even approach"},
    {"pair.secant", "force over the approach that the line load weighs"},
    {"roll.reaction_drive", "force of the bearing on the drive side, upwards on the roll"},
    {"roll.reaction_operator", "force of the bearing on the operator side, upwards on the roll"},
    {"roll.bearing_stiffness", "radial stiffness of the heavier of its bearings under its load"},
    {"roll.bending_stress", "largest bending stress"},
    {"roll.deflection", "deflection upwards of the middle against the ends of the barrel"}};

std::string stack_word(const std::string &key)
{
  const auto known = stack_words.find(key);
  return known == stack_words.end() ? "" : known->second;
}

// influence.crown.W.bending_force, influence.edge_drop.force
std::string influence_meaning(const std::vector<std::string> &parts)
{
  const std::string moved =
      is_word(parts[1], ResultWord::crown) ? "change of the crown with " : "change of the edge drop with ";
  if (parts.size() == 3)
    return moved + "the rolling force";
  const auto input = choice_named<ResultWord>(parts[3]);
  if (input == ResultWord::crown)
    return parts[2] + ", " + moved + "its own crown on the diameter, both halves";
  if (input == ResultWord::shift)
    return parts[2] + ", " + moved + "its shift to the drive side; a turned lower roll moves the other way";
  if (input == ResultWord::bending_force)
    return parts[2] + ", " + moved + "the bending force of each chock, both halves";
  return parts[2] + ", " + moved + "the eccentric of saddle " + parts[3].substr(std::string("eccentric").size());
}
}  // namespace

std::string stack_meaning(const std::string &name)
{
  const auto parts = parts_of(name);
  if (parts.size() < 2)
    return "";
  if (parts[0] == family::stack)
    return parts[1][0] == 'f' && is_digits(parts[1].substr(1))
               ? "natural frequency " + parts[1].substr(1) + " of the stack"
               : stack_word(name);
  if (parts.size() < 3)
    return "";
  if (parts[0] == family::influence)
    return influence_meaning(parts);
  if (parts[0] != family::pair && parts[0] != family::roll)
    return "";
  if (const std::string saddle = "reaction_saddle"; parts[2].rfind(saddle, 0) == 0)
    return parts[1] + ", force of saddle " + parts[2].substr(saddle.size()) + ", upwards on the roll";
  const std::string word = stack_word(parts[0] + "." + parts[2]);
  return word.empty() ? "" : parts[1] + ", " + word;
}

std::vector<Group> stack_groups(const Run &run)
{
  std::vector<Group> groups{
      {"Strip and stack", {}}, {"Contacts of the rolls", {}}, {"What moves the profile", {}}};
  for (const Result &result : run.results) {
    const auto parts = parts_of(result.name);
    if (parts[0] == family::stack)
      groups[0].results.push_back(&result);
    const auto last = choice_named<ResultWord>(parts.back());
    if (parts[0] == family::pair &&
        (last == ResultWord::force || last == ResultWord::q_max || last == ResultWord::peak_pressure))
      groups[1].results.push_back(&result);
    if (parts[0] == family::influence && is_word(parts[1], ResultWord::crown))
      groups[2].results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
