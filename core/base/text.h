#pragma once
#include <string_view>

namespace mill {
/// Cost O(n) of the ending.
constexpr bool text_ends_with(const std::string_view text, const std::string_view ending)
{
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

/// Whether one of these characters is in it.
constexpr bool has_any(const std::string_view text, const std::string_view characters)
{
  return text.find_first_of(characters) != std::string_view::npos;
}

/// Whether it is made of these characters, or empty.
constexpr bool has_only(const std::string_view text, const std::string_view characters)
{
  return text.find_first_not_of(characters) == std::string_view::npos;
}

/// Empty, or blanks and tabulators alone.
constexpr bool is_blank(const std::string_view text)
{
  return has_only(text, " \t");
}

/// What some programs write before the first line of a text in UTF-8.
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
}  // namespace mill
