#include "core/base/visible_text.h"
#include "core/base/name_part.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
// Bytes of the UTF-8 character at `at`, 0 where there is none (RFC 3629).
std::size_t length_at(const std::string &text, const std::size_t begin, char32_t &code)
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

bool turns_the_writing(const char32_t code)
{
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

// Line and paragraph separator end a line for some readers.
bool is_hidden(const char32_t code)
{
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         turns_the_writing(code);
}
}  // namespace

std::string visible(const std::string &stored, const bool one_line)
{
  const std::string text = with_plain_names(stored);
  std::string out;
  out.reserve(text.size());
  for (std::size_t position = 0; position < text.size();) {
    char32_t code       = 0;
    const std::size_t n = length_at(text, position, code);
    const bool layout   = !one_line && (code == '\n' || code == '\t');
    if (n == 0)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[position]));
    else if (!is_hidden(code) || layout)
      out.append(text, position, n);
    else if (code == '\n' || code == '\t' || code == '\r')
      out += code == '\n' ? "\\n" : code == '\t' ? "\\t" : "\\r";
    else
      out += code < 0x80 ? fmt::format("\\x{:02x}", unsigned(code)) : fmt::format("\\u{:04x}", unsigned(code));
    position += std::max<std::size_t>(n, 1);
  }
  return out;
}
}  // namespace mill
