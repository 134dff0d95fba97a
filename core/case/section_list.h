#pragma once
#include "core/case/stand_reader.h"
#include <fmt/format.h>
#include <string>
#include <vector>

namespace mill {
/// Sections in double brackets below another one: [[advice.damper]] of [advice].
template <class T>
std::vector<T> read_list(const Section &section, const char *key, const std::vector<Field<T>> &rows,
                         Reading &reading)
{
  std::vector<T> list;
  const Node::Entry *entry = section.node ? section.node->find(key) : nullptr;
  if (!entry)
    return list;
  const std::string all = section.key(key);
  if (entry->value.kind != Node::Kind::array) {
    reading.bad.insert(all);
    reading.add(entry->key_place, fmt::format("[[{}]] is written in double brackets, once for each", all));
    return list;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const Node &node       = entry->value.items[i];
    const std::string name = fmt::format("{}.{}", all, i);
    if (node.kind != Node::Kind::table) {
      reading.add(node.place,
                  fmt::format("{} = {} is a value; a section [[{}]] is needed", name, shown(node), all));
      continue;
    }
    T one;
    read_and_echo(Section{&node, name}, "[[" + all + "]]", rows, one, reading);
    list.push_back(one);
  }
  return list;
}
}  // namespace mill
