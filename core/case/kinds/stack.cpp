#include "core/case/kinds.h"
#include "core/case/stack_rows.h"
#include "core/case/stand_sections.h"

namespace mill {
StackCase read_stack(const Node &root, Reading &reading);

namespace {
using Values = std::map<std::string, std::string>;

// A four-high stand, the demo stand of the other templates.
std::vector<TemplateNote> stack_notes()
{
  const Values backup{{"name", quoted("B")},
                      {"barrel_diameter", quoted("1450 mm")},
                      {"neck_diameter", quoted("950 mm")},
                      {"total_length", quoted("3300 mm")},
                      {"bearing_span", quoted("2450 mm")},
                      {"chock_mass", quoted("12400 kg")}};
  return {
      {"roll", "", {}, {"neck_diameter", "total_length", "bearing_span", "on", "bending_force", "chock_mass"}},
      {"roll", "", backup, {"neck_diameter", "total_length", "bearing_span", "bearing_stiffness", "chock_mass"}},
      {"roll.saddles", "", {}, {}, true},
      {"bearing", "[bearing.crb]", {}, {}, true},
      {"material", "[material.carbide]", {}, {}, true},
      {"strip", "", {}, {"force", "modulus", "contact_length", "entry_thickness", "exit_thickness"}},
      {"strip.flow_stress", "", {}, {}, true},
      {"strip.friction", "", {}, {}, true},
      {"window", "", {}, {}, true},
      {"pass", "", {}, {"load", "speed"}, true}};
}
}  // namespace

const CaseKind &case_kind(const StackCase *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    using Repeat = SectionRows::Repeat;
    k.name       = word_of(KindOfCase::stack);
    k.title      = "stack of rolls that bend, with the profile of the strip";
    k.read       = [](const Node &root, Reading &reading) -> CaseSpec { return read_stack(root, reading); };
    k.sections   = {
          head_section(),
          steel_section(),
          {"material", Repeat::named, false, "another material of rolls", rows_of(stack_material_rows())},
          {"stack", Repeat::once, false, "what is common to the rolls", rows_of(stack_settings_rows())},
          {"roll", Repeat::list, true, "one roll", rows_of(stack_roll_rows())},
          {"roll.saddles", Repeat::once, false, "backing shaft of the roll above, in place of its bearings",
           rows_of(stack_saddle_rows())},
          {"bearing", Repeat::named, false, "a roller bearing, named by the rolls that it holds",
           rows_of(bearing_rows())},
          {"strip", Repeat::once, true, "the strip between the work rolls", rows_of(stack_strip_rows())},
    };
    for (const SectionRows &section : strip_sections())
      if (section.name != "strip") {
        k.sections.push_back(section);
        k.sections.back().needed = false;
      }
    k.sections.push_back(
        {"engine", Repeat::once, false, "how the stack is computed", rows_of(stack_engine_rows())});
    k.sections.push_back(
        {"window", Repeat::once, false, "maps around the settings of the case", rows_of(stack_window_rows())});
    k.sections.push_back(pass_section(false));
    k.sections.push_back(dynamics_section(stack_dynamics_rows()));
    k.sections.push_back({"stand", Repeat::once, false, "the strip around the stand, for millstand chatter",
                          rows_of(stand_span_rows())});
    k.sections.push_back(
        {"analysis", Repeat::once, false, "how chatter is searched", rows_of(chatter_analysis_rows())});
    k.notes    = stack_notes();
    k.repeated = [](const CaseSpec &spec, const std::string &section) {
      const StackInput &input = *std::get<StackCase>(spec).input;
      if (section == "material")
        return names_in(input.materials);
      if (section == "bearing")
        return names_in(input.bearings);
      if (section == "roll.saddles") {
        std::vector<std::string> with_saddles;
        for (std::size_t r = 0; r < input.rolls.size(); ++r)
          if (input.rolls[r].saddles.given)
            with_saddles.push_back(std::to_string(r));
        return with_saddles;
      }
      if (section == "pass")
        return numbers_to(input.passes.size());
      return section == "roll" ? numbers_to(input.rolls.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
