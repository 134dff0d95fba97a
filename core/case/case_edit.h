#pragma once
#include <string>
#include <vector>

namespace mill {
/// A case file with one value changed; every other line, its comments and its order stay as they are.
///
/// A key of the file gets the new value at its place.  A key that is not in the file takes the place
/// of its comment line "# key = .." in its section, or is added behind the last key of the section; a section that
/// is missing is added at the end.  A section that is written with dotted keys gets another one.  `[[pass]]`
/// number n of n passes is added with a name.
/// @param text  TOML; lines may end in CRLF
/// @param key   full, as --set has it: "work_roll.barrel_diameter", "pass.0.load", "bearing.\"crb 1.5\".bore"
/// @param toml  value as TOML, on one line; empty: the line of the key becomes a comment
/// @throws InputError  text that is not TOML; a key inside an inline table that is not in the file
/// Cost: one to three parses.
std::string with_value(const std::string &text, const std::string &key, const std::string &toml);

/// A value as it stands in a case file.
struct WrittenValue {
  std::string key;   ///< full, as with_value() takes it
  std::string text;  ///< of a text without its quotes; otherwise TOML
  int line = 0;      ///< of the key
};
/// Every value of a case file, in its order.  @throws InputError  text that is not TOML
std::vector<WrittenValue> written_values(const std::string &text);

/// What a user typed for a key as TOML: what is TOML of a fitting form stays, the rest becomes a text, so that the
/// reader of the case judges it.
/// @param of_text  the value is a text or a quantity, never a bare word
std::string toml_as_typed(const std::string &typed, bool of_text);
}  // namespace mill
