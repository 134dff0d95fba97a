#pragma once
#include <string>
#include <vector>

namespace mill {
/// A key that an earlier version had.
struct RemovedKey {
  const char *key;
  const char *last_version;  ///< the last one that had it
  const char *successor;     ///< key that took its place; empty: none did
  const char *remedy;        ///< what to do with the line
};

/// Every key that was ever removed from a case file.
const std::vector<RemovedKey> &removed_keys();

/// "; version 0.1.0 was the last one with it: ..", or nothing for a key that never was one.
std::string removal_note(const std::string &key);
}  // namespace mill
