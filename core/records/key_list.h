#pragma once
#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

// Keys of a case, as a list without repetition.
namespace mill {
using KeyList = std::vector<std::string>;

/// "a b" -> a, b
KeyList words_of(const std::string &names);
/// "frame", "a b" -> frame.a, frame.b
KeyList keys_in(const std::string &section, const std::string &names);

inline bool holds(const KeyList &list, const std::string &key)
{
  return std::find(list.begin(), list.end(), key) != list.end();
}

/// Adds what `all` has not yet, list by list, each key once.
/// @param all  holds none twice
void add_keys(KeyList &all, std::initializer_list<const KeyList *> lists);

/// All keys of the lists in order, each once.
/// @param all  the first list, which holds none twice
template <class... Lists> KeyList joined(KeyList all, const Lists &...lists)
{
  add_keys(all, {&lists...});
  return all;
}
}  // namespace mill
