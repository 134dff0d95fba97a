#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
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
const CaseKind &case_kind(const TwoCylinders *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    using Repeat = SectionRows::Repeat;
    k.name       = "two-cylinders";
    k.title      = "two cylinders";
    k.read     = [](const Node &root, Reading &reading) -> CaseSpec { return read_two_cylinders(root, reading); };
    k.sections = {
        head_section(),
        steel_section(),
        {"upper",        Repeat::once, true, "the upper cylinder", rows_of(upper_cylinder_rows())},
        {"lower",        Repeat::once, true, "the lower cylinder", rows_of(lower_cylinder_rows())},
        {"contact.line", Repeat::once, true, "their contact",      rows_of(line_contact_rows())  }
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
