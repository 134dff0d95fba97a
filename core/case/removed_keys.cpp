#include "core/case/removed_keys.h"
#include <fmt/format.h>

namespace mill {
const std::vector<RemovedKey> &removed_keys()
{
  static const std::vector<RemovedKey> keys{
      {"tilt_lever", "0.1.0", "",
       "a turn of the inner ring now always presses a tapered roller by its full moment; delete the line"},
      // accepted with a warning where the new name is not given as well (old_keys.cpp)
      {"row_hands", "0.1.0", "arrangement", "write the value under the new name"},
  };
  return keys;
}

std::string removal_note(const std::string &key)
{
  for (const RemovedKey &removed : removed_keys())
    if (key == removed.key)
      return std::string(removed.successor).empty()
                 ? fmt::format("; it was dropped after version {}: {}", removed.last_version, removed.remedy)
                 : fmt::format("; it was replaced by '{}' after version {}: {}", removed.successor,
                               removed.last_version, removed.remedy);
  return "";
}
}  // namespace mill
