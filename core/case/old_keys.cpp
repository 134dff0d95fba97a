#include "core/case/old_keys.h"
#include <fmt/format.h>

namespace mill {
namespace {
struct OldKey {
  const char *sections;  // [bearing.NAME] by "bearing"
  const char *old_name, *name;
};
constexpr OldKey old_keys[] = {{"bearing", "row_hands", "arrangement"}};

void rename(Node &table, const std::string &section, const OldKey &key, Reading &reading)
{
  if (table.find(key.name))
    return;
  for (Node::Entry &entry : table.entries)
    if (entry.key == key.old_name) {
      entry.key = key.name;
      Warning warning{WarningId::old_key, "",
                      fmt::format("{}.{} is the old name of the key {}", section, key.old_name, key.name), "",
                      fmt::format("write {}", key.name)};
      warning.key   = section + "." + key.name;
      warning.place = entry.key_place;
      reading.warnings.push_back(std::move(warning));
    }
}
}  // namespace

void accept_old_keys(Node &root, Reading &reading)
{
  for (const OldKey &key : old_keys)
    for (Node::Entry &group : root.entries)
      if (group.key == key.sections)
        for (Node::Entry &entry : group.value.entries)
          rename(entry.value, group.key + "." + entry.key, key, reading);
}
}  // namespace mill
