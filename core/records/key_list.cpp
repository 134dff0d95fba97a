#include "core/records/key_list.h"
#include <functional>

namespace mill {
KeyList words_of(const std::string &names)
{
  KeyList list;
  const char *const blanks = " \n";
  for (auto from = names.find_first_not_of(blanks); from != std::string::npos;) {
    const auto to = std::min(names.find_first_of(blanks, from), names.size());
    list.push_back(names.substr(from, to - from));
    from = names.find_first_not_of(blanks, to);
  }
  return list;
}

KeyList keys_in(const std::string &section, const std::string &names)
{
  KeyList keys = words_of(names);
  for (std::string &key : keys)
    key = section + "." + key;
  return keys;
}

// A hash table of the least kind: results have hundreds of keys, and lists are joined for every one of them.
void add_keys(KeyList &all, const std::initializer_list<const KeyList *> lists)
{
  std::size_t most = all.size();
  for (const KeyList *list : lists)
    most += list->size();
  all.reserve(most);  // no key moves while the table looks at it
  std::size_t places = 16;
  while (places < 2 * most)
    places *= 2;
  std::vector<const std::string *> table(places);
  const auto place_of = [&](const std::string &key) -> const std::string *& {
    std::size_t i = std::hash<std::string>()(key) & (places - 1);
    while (table[i] && *table[i] != key)
      i = (i + 1) & (places - 1);
    return table[i];
  };
  for (const std::string &key : all)
    place_of(key) = &key;
  for (const KeyList *list : lists)
    for (const std::string &key : *list)
      if (const std::string *&place = place_of(key); !place) {
        all.push_back(key);
        place = &all.back();
      }
}
}  // namespace mill
