#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"

namespace mill {
namespace {
// Plane strain or space: one section says which.
void read_contact(const Node &root, TwoCylinders &pair, Reading &reading)
{
  const Section contact = section_at(root, "contact", reading);
  if (contact.node)
    refuse_unknown_keys(contact, {}, {"line", "space"}, reading);
  const Node::Entry *line  = contact.node ? contact.node->find("line") : nullptr;
  const Node::Entry *space = contact.node ? contact.node->find("space") : nullptr;
  pair.in_space            = space && !line;
  if (line && space)
    reading.add(space->key_place,
                "[contact.space] and [contact.line] are both given; a case is computed in plane "
                "strain or in space: leave one of the two out",
                {line->key_place});
  const auto read_section = [&](const std::string &name, const auto &rows, auto &out) {
    const Section section = section_at(root, name, reading);
    read_and_echo(section, section.header(), rows, out, reading);
  };
  if (pair.in_space) {
    read_section("contact.space", space_contact_rows(), pair.space);
    return;
  }
  read_section("contact.line", line_contact_rows(), pair.contact);
  pair.contact.loads_place    = reading.place("contact.line.loads");
  pair.contact.elements_place = reading.place("contact.line.elements_per_half_width");
  check_contact("contact.line", pair.contact, reading);
}
}  // namespace

TwoCylinders read_two_cylinders(const Node &root, Reading &reading)
{
  TwoCylinders pair;
  const Section steel = section_at(root, "steel", reading);
  read_and_echo(steel, steel.header(), steel_rows(), pair.steel, reading);
  for (const char *name : {"upper", "lower"}) {
    const Section section = section_at(root, name, reading);
    read_and_echo(section, section.header(), body_rows_for(section),
                  section.name == "upper" ? pair.upper : pair.lower, reading);
  }
  read_contact(root, pair, reading);
  check_bodies(pair, reading);
  return pair;
}

const CaseKind &case_kind(const TwoCylinders *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    using Repeat = SectionRows::Repeat;
    k.name       = word_of(KindOfCase::two_cylinders);
    k.title      = "two cylinders";
    k.read     = [](const Node &root, Reading &reading) -> CaseSpec { return read_two_cylinders(root, reading); };
    k.sections = {
        head_section(),
        steel_section(),
        {"upper", Repeat::once, true, "the upper body", rows_of(upper_body_rows())},
        {"lower", Repeat::once, true, "the lower body", rows_of(lower_body_rows())},
        {"contact.line", Repeat::once, false, "their contact in plane strain", rows_of(line_contact_rows())},
        {"contact.space", Repeat::once, false, "their contact in space, in its place",
         rows_of(space_contact_rows())}};
    k.notes = {{"contact.space", "", {}, {}, true}};
    return k;
  }();
  return kind;
}
}  // namespace mill
