#pragma once
#include "core/case/fields.h"
#include <string>
#include <vector>

namespace mill {
struct Case;

/// One input of a sweep or a study, and the values that it takes.
struct VariedKey {
  std::string name;                 ///< "backup_roll.crown"
  std::string path;                 ///< as --set addresses it; names with dots in quotes
  std::string meaning;              ///< of its row
  std::string unit;                 ///< of `numbers`, "um"; empty: pure numbers or words
  std::vector<std::string> values;  ///< as --set takes them, "50 um", "solid"
  std::vector<double> numbers;      ///< in `unit`; NaN where the value is a word
  bool pair = false;                ///< a pair of which both have the same value: bending of both chocks
};

/// A number as --set takes it: with its unit, twice for a pair.
std::string number_value(double number, const std::string &unit, bool pair);

/// The key of "KEY=..." or "KEY~..." and what follows it.
/// @param sign  '=' or '~'
/// @throws InputError  no sign, nothing before or behind it
struct WrittenVariation {
  std::string key, values;
};
WrittenVariation split_variation(const std::string &written, char sign);

/// A key of the case by its name.
struct KnownKey {
  std::string name, path;  ///< as in VariedKey
  Row row;
};
/// @throws InputError  unknown key, with the nearest known one
KnownKey known_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &name);

/// Parts of a text between commas that are outside of quotes and brackets, without blanks around them.
std::vector<std::string> list_items(const std::string &text);

/// Reads "KEY=a,b,c" or "KEY=lo..hi:n" (n values, both ends taken).  A unit may follow every number or the last
/// one alone: "0,50,100 um", "0..200 um:21".
/// @throws InputError  unknown key; a number without unit or of another dimension; an interval that is reversed or
/// empty; a value twice
VariedKey varied_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &written);

/// The keys of a command.  @throws InputError  as varied_key(); one key twice
std::vector<VariedKey> varied_keys(const Case &the_case, const std::vector<std::string> &sets,
                                   const std::vector<std::string> &written);

/// @throws InputError  a key twice
void require_different_keys(const std::vector<std::string> &names);
}  // namespace mill
