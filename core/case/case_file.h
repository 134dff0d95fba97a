#pragma once
#include "core/base/errors.h"
#include <string>
#include <vector>

namespace mill {
/// One value of a case file with its place.  Tables keep their entries in the order of the file.
struct Node {
  enum class Kind { table, array, text, integer, real, flag, other };
  struct Entry;
  Kind kind = Kind::table;
  Place place;                                      ///< of the value; of the header for a section
  std::string text;                                 ///< kind text
  double number = 0;                                ///< kinds integer and real, as written
  bool flag     = false;                            ///< kind flag
  bool section  = false;                            ///< a table or array made with [..] or [[..]] and not inline
  std::vector<Entry> entries;                       ///< kind table
  std::vector<Node> items;                          ///< kind array
  const Entry *find(const std::string &key) const;  ///< nullptr when absent or no table
};

/// One "key = value" with the place of the key.
struct Node::Entry {
  std::string key;
  Place key_place;
  Node value;
};

/// The value as the user wrote it: "\"420 mm\"", "0.2", "[...]".
std::string shown(const Node &node);

/// Reads a TOML file and lays the overrides "section.key=value" over it.  Passes are addressed by index, from 0:
/// "pass.0.name=first".  A value that is not TOML is read as text, so that 'section.key=400 mm' needs no inner
/// quotes; its place is "--set section.key=value", line 0.
/// @throws InputError  file missing (with the nearest name in its folder), not TOML (with the place, and the
///                     remedy for a quantity without quotes or a key given twice), override malformed
Node read_case_file(const std::string &path, const std::vector<std::string> &sets = {});
/// The same of a text that stands in the place of the file `path`.
Node read_case_text(const std::string &path, const std::string &text, const std::vector<std::string> &sets = {});
}  // namespace mill
