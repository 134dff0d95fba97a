#pragma once
#include <string_view>

namespace mill {
/// Cost O(n) of the ending.
constexpr bool text_ends_with(const std::string_view text, const std::string_view ending)
{
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}
}  // namespace mill
