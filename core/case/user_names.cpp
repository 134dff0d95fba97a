#include "core/case/user_names.h"
#include "core/base/name_part.h"
#include <algorithm>
#include <string_view>

namespace mill {
namespace {
// Where a name is given or referred to: the key in the section, or in each of a list of them.
struct NamedKey {
  std::string_view section, key;
};
constexpr NamedKey named_keys[] = {
    {"pass", "name"},           {"condition", "name"},  {"condition", "after"},  {"work_roll", "bearing"},
    {"backup_roll", "bearing"}, {"load", "bearing"},    {"advice", "condition"}, {"stack", "strip"},
    {"roll", "name"},           {"roll", "on"},         {"roll", "material"},    {"roll", "bearing"},
    {"contact", "pair"},        {"contact", "like"},    {"support", "roll"},     {"support", "name"},
    {"support", "like"},        {"support", "against"}, {"mode", "name"},        {"variant", "name"},
    {"variant", "pass"},        {"variant", "modes"}};
constexpr std::string_view named_sections[] = {"bearing", "variant", "material"};

void make_part(Node &value)
{
  if (value.kind == Node::Kind::text)
    value.text = name_part(value.text);
  for (Node &item : value.items)
    if (item.kind == Node::Kind::text)
      item.text = name_part(item.text);
}

void make_parts_in(Node &section, const std::string_view name)
{
  for (Node::Entry &entry : section.entries)
    for (const NamedKey &named : named_keys)
      if (named.section == name && named.key == entry.key)
        make_part(entry.value);
}
}  // namespace

void make_names_parts(Node &root)
{
  for (Node::Entry &group : root.entries) {
    if (group.value.kind == Node::Kind::table) {
      make_parts_in(group.value, group.key);
      if (std::find(std::begin(named_sections), std::end(named_sections), group.key) != std::end(named_sections))
        for (Node::Entry &entry : group.value.entries)
          entry.key = name_part(entry.key);
    }
    for (Node &item : group.value.items)
      make_parts_in(item, group.key);
  }
}
}  // namespace mill
