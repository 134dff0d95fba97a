#pragma once
#include <chrono>

namespace mill {
/// s since 1970
inline double utc_now()
{
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}
}  // namespace mill
