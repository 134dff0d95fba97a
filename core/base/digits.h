#pragma once
#include <algorithm>
#include <string_view>

namespace mill {
/// Digits and nothing else, at least one.
inline bool is_digits(const std::string_view text)
{
  return !text.empty() && std::all_of(text.begin(), text.end(), [](const char c) { return c >= '0' && c <= '9'; });
}
}  // namespace mill
