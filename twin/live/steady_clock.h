#pragma once
#include <chrono>

namespace mill::live {
/// s, of a clock that is never set.
inline double steady_now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}  // namespace mill::live
