#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace mill {
/// How often a row was under way when its program ended.
struct EarlierEnds {
  int all = 0, crashes = 0;
};

/// Of all rows that earlier processes of a shard have begun and not finished.
/// @param shard  "3-of-8", "search"
std::map<std::int64_t, EarlierEnds> earlier_ends(const std::string &folder, const std::string &shard);

/// A row that crashed the program twice is not tried again, nor one that was under way at six kills from outside:
/// an operator, the end of a slot, no memory.
bool gives_up(const EarlierEnds &ends);
/// Its failure.
std::string sentence_of(const EarlierEnds &ends);

/// From now on a fault of this program leaves a file, by which it differs from a kill from outside.
void mark_own_crash(const std::string &path);
}  // namespace mill
