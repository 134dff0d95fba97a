#include "core/case/given_instead.h"
#include "core/case/stand_reader.h"
#include "core/model/bite_case.h"

namespace mill {
namespace {
// friction = 0.2, or a section [strip.friction] with a law.
void read_friction(const Section &strip, StripInput &input, Reading &reading)
{
  const Node::Entry *entry = strip.node ? strip.node->find("friction") : nullptr;
  if (!entry || entry->value.kind != Node::Kind::table) {
    input.friction.coefficient = input.coulomb;
    return;
  }
  const Section law = section_at(*strip.node, "friction", reading);
  input.friction    = read_friction_law({law.node, "strip.friction"}, reading);
}

// The rows of [strip] without the number that a section [strip.friction] represents.
std::vector<Field<StripInput>> rows_without_friction(std::vector<Field<StripInput>> rows)
{
  rows.pop_back();
  return rows;
}

// The constants of a law with what its name represents; a name that is none has been refused.
template <class Law, class Input, class Parse> Law law_of(const Input &input, const Parse &parse)
{
  Law law = input;
  law.law = parse(input.name);
  return law;
}
}  // namespace

FlowStress read_flow_stress(const Node &root, Reading &reading)
{
  const Section section = section_at(root, "strip.flow_stress", reading);
  FlowStressInput input;
  read_and_echo(section, section.header(), flow_stress_rows(), input, reading);
  return law_of<FlowStress>(input, flow_stress_law);
}

Friction read_friction_law(const Section &section, Reading &reading)
{
  FrictionInput input;
  read_and_echo(section, section.header(), friction_rows(), input, reading);
  return law_of<Friction>(input, friction_law);
}

Strip read_strip(const Node &root, Reading &reading, const std::set<std::string> *given)
{
  StripInput strip;
  const auto all           = given ? beside_given("strip", strip_rows(), *given, strip) : strip_rows();
  const Section section    = section_at(root, "strip", reading);
  const Node::Entry *entry = section.node ? section.node->find("friction") : nullptr;
  const bool has_law       = entry && entry->value.kind == Node::Kind::table;
  read_and_echo(section, section.header(), has_law ? rows_without_friction(all) : all, strip, reading,
                has_law ? std::vector<std::string>{"flow_stress", "friction"}
                        : std::vector<std::string>{"flow_stress"});
  if (!section.node) {
    reading.bad.insert("strip.flow_stress.law");  // no further error for a section that is not there
    return strip;
  }
  if (section.node->find("flow_stress") || !given || !is_needless("strip", "flow_stress", *given))
    strip.flow_stress = read_flow_stress(root, reading);
  else
    reading.bad.insert("strip.flow_stress.law");
  read_friction(section, strip, reading);
  return strip;
}

BiteSetup read_bite_setup(const Node &root, Reading &reading)
{
  BiteSetup setup;
  const Section section = section_at(root, "bite", reading);
  read_and_echo(section, section.header(), bite_rows(), setup, reading);
  return setup;
}

BiteCase read_bite_case(const Node &root, Reading &reading)
{
  BiteCase spec;
  BiteRollInput roll;
  const Section steel = section_at(root, "steel", reading), work_roll = section_at(root, "work_roll", reading);
  read_and_echo(steel, steel.header(), steel_rows(), spec.steel, reading);
  read_and_echo(work_roll, work_roll.header(), bite_roll_rows(), roll, reading);
  spec.roll_diameter = roll.diameter;
  spec.strip         = read_strip(root, reading);
  spec.passes        = read_passes(root, bite_pass_rows(), reading);
  spec.bite          = read_bite_setup(root, reading);
  spec.published     = read_given(root, "published", "bite", reading);
  if (spec.passes.empty() && reading.usable({"pass"}))
    reading.add(Place{reading.file}, "no [[pass]] is given; give at least its name");
  check_pass_names(spec.passes, reading);
  check_strip(spec.strip, reading);
  check_passes_in_bite(spec.passes, spec.strip, reading);
  check_bite_setup(spec.bite, spec.strip.friction, reading);
  check_fit(spec.bite, spec.strip, spec.passes, reading);
  return spec;
}
}  // namespace mill
