#pragma once
#include <string_view>

namespace mill {
/// Cost O(n) of the ending.
constexpr bool text_ends_with(const std::string_view text, const std::string_view ending)
{
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

/// Empty, or blanks and tabulators alone.
constexpr bool is_blank(const std::string_view text)
{
  return text.find_first_not_of(" \t") == std::string_view::npos;
}

/// What some programs write before the first line of a text in UTF-8.
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
}  // namespace mill
