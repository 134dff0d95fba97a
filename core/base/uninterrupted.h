#pragma once
#include <cerrno>
#include <type_traits>

namespace mill {
/// A call of the system that a signal interrupted (EINTR) is made again: open, read, write, fsync, rename, fopen.
/// @param call  returns a number, negative when it fails, or a pointer, null when it fails, with errno
template <class Call> auto uninterrupted(const Call &call)
{
  const auto failed = [](const auto result) {
    if constexpr (std::is_pointer_v<decltype(result)>)
      return result == nullptr;
    else
      return result < 0;
  };
  auto result = call();
  while (failed(result) && errno == EINTR)
    result = call();
  return result;
}
}  // namespace mill
