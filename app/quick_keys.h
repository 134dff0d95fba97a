#pragma once
#include <algorithm>
#include <string>
#include <vector>

// Lists of keys of the case file, as a Parameter carries them.
namespace mill {
using KeyList = std::vector<std::string>;

/// "frame", "a b" -> frame.a, frame.b
KeyList keys_in(const std::string &section, const std::string &names);

inline bool holds(const KeyList &list, const std::string &key)
{
  return std::find(list.begin(), list.end(), key) != list.end();
}

/// All keys of the lists in order, each once.
template <class... Lists> KeyList joined(const Lists &...lists)
{
  KeyList all;
  const auto add = [&](const KeyList &list) {
    for (const std::string &key : list)
      if (!holds(all, key))
        all.push_back(key);
  };
  (add(lists), ...);
  return all;
}

/// Where a number of the chain comes from.
struct Station {
  std::string road;               ///< "springs in series"
  std::string file;               ///< that computes it
  std::string equation;           ///< of docs/theory.md
  std::vector<std::string> from;  ///< numbers of the chain it is made of
  KeyList own;                    ///< keys that enter beside those
};

/// Of M1..M6, K1, K2, K6, K7 and K_ZW.
/// @param reference  dynamics.mass_reference
Station station_of(const std::string &name, const std::string &reference);
}  // namespace mill
