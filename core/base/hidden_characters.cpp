#include "core/base/hidden_characters.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
std::size_t utf8_length(const std::string_view text, const std::size_t begin, char32_t &code)
{
  const auto first    = static_cast<unsigned char>(text[begin]);
  const std::size_t n = first < 0x80   ? 1
                        : first < 0xC2 ? 0
                        : first < 0xE0 ? 2
                        : first < 0xF0 ? 3
                        : first < 0xF5 ? 4
                                       : 0;
  if (n == 0 || begin + n > text.size())
    return 0;
  code = n == 1 ? first : first & (0xFF >> (n + 1));
  for (std::size_t i = 1; i < n; ++i) {
    const auto next = static_cast<unsigned char>(text[begin + i]);
    if ((next & 0xC0) != 0x80)
      return 0;
    code = code << 6 | (next & 0x3F);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter forms of these exist
  const bool surrogate       = code >= 0xD800 && code <= 0xDFFF;
  return code < least[n] || code > 0x10FFFF || surrogate ? 0 : n;
}

namespace {
bool turns_the_writing(const char32_t code)
{
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}
}  // namespace

bool is_hidden(const char32_t code)
{
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         turns_the_writing(code);
}

bool has_hidden(const std::string &text)
{
  bool hidden = false;
  escaped(text, [&](char32_t) {
    hidden = true;
    return std::string();
  });
  return hidden;
}

std::string escaped(const std::string &text, const std::function<std::string(char32_t code)> &how)
{
  std::string out;
  out.reserve(text.size());
  for (std::size_t position = 0; position < text.size();) {
    char32_t code       = 0;
    const std::size_t n = utf8_length(text, position, code);
    if (n > 0 && is_hidden(code))
      out += how(code);
    else
      out.append(text, position, std::max<std::size_t>(n, 1));
    position += std::max<std::size_t>(n, 1);
  }
  return out;
}

std::string number_of_character(const char32_t code)
{
  return code < 0x80 ? fmt::format("\\x{:02x}", unsigned(code)) : fmt::format("\\u{:04x}", unsigned(code));
}
}  // namespace mill
