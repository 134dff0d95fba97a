#pragma once
#include <string>

namespace mill {
/// Begin of the name of a roll of a stack that is made: the mirror image of a listed one in the lower half.
constexpr const char *made_roll_prefix = "lower_";

inline std::string made_roll_name(const std::string &listed)
{
  return made_roll_prefix + listed;
}
}  // namespace mill
