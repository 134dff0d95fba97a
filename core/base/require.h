#pragma once
#include <stdexcept>
#include <string>

namespace mill {
/// What a function relies on and another part of the program has to keep. Checked in every build, since a release
/// that goes on with wrong data prints wrong numbers.
/// @throws std::logic_error  with `what`: our own mistake, exit code 1
inline void require(const bool holds, const char *what)
{
  if (!holds)
    throw std::logic_error(what);
}
inline void require(const bool holds, const std::string &what)
{
  require(holds, what.c_str());
}
}  // namespace mill
