#include "core/case/nesting.h"
#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace mill {
namespace {
// First byte behind the string that begins at `begin`.  A string of one line ends with its line at the latest.
std::size_t end_of_string(const std::string_view text, const std::size_t begin)
{
  const char quote     = text[begin];
  const bool escapes   = quote == '"';
  const bool many_line = text.substr(begin, 3) == std::string(3, quote);
  for (std::size_t i = begin + (many_line ? 3 : 1); i < text.size(); ++i) {
    if (escapes && text[i] == '\\')
      ++i;
    else if (many_line && text.substr(i, 3) == std::string(3, quote)) {
      i += 3;  // up to two quotes more belong to the text
      for (int more = 0; more < 2 && i < text.size() && text[i] == quote; ++more)
        ++i;
      return i;
    } else if (!many_line && text[i] == quote)
      return i + 1;
    else if (!many_line && text[i] == '\n')
      return i;
  }
  return text.size();
}

Place place_of(const std::string_view text, const std::size_t byte, const std::string &file)
{
  const auto before        = text.substr(0, byte);
  const auto line_begin    = before.rfind('\n') + 1;  // npos + 1 is the beginning of the text
  const auto is_first_byte = [](const char c) { return (c & 0xC0) != 0x80; };
  return {file, 1 + int(std::count(before.begin(), before.end(), '\n')),
          1 + int(std::count_if(before.begin() + std::ptrdiff_t(line_begin), before.end(), is_first_byte))};
}
}  // namespace

std::optional<Place> too_deep(const std::string &toml, const std::string &file)
{
  int brackets = 0, names = 1;
  for (std::size_t i = 0, end = 0; i < toml.size(); i = end) {
    const char c = toml[i];
    end          = i + 1;
    if (c == '#')
      end = std::min(toml.find('\n', i), toml.size());
    else if (c == '"' || c == '\'')
      end = end_of_string(toml, i);
    else if (c == '.')
      ++names;
    else if (c == '[' || c == '{')
      ++brackets;
    else if (c == ']' || c == '}')
      brackets = std::max(0, brackets - 1);
    if (brackets > deepest_nesting || names > deepest_nesting)
      return place_of(toml, i, file);
    if (c == '=' || c == ',' || c == '\n' || c == '[' || c == '{' || c == ']' || c == '}')
      names = 1;
  }
  return std::nullopt;
}

std::string nesting_refusal()
{
  return fmt::format(
      "this nests deeper than {} levels, deeper than any key of a case; look for a bracket that is not "
      "closed or for dots in place of values",
      deepest_nesting);
}
}  // namespace mill
