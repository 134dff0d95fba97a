#include "core/base/valid_text.h"
#include "core/base/hidden_characters.h"
#include <algorithm>
#include <array>
#include <cstring>

namespace mill {
namespace {
constexpr char32_t replacement = 0xFFFD;

// Windows-1252 from 0x80 to 0x9F.  Source: Unicode Consortium, MAPPINGS/VENDORS/MICSFT/WINDOWS/CP1252.TXT.
constexpr std::array<char32_t, 32> western{
    0x20AC,      replacement, 0x201A, 0x0192, 0x201E, 0x2026,      0x2020, 0x2021,       //
    0x02C6,      0x2030,      0x0160, 0x2039, 0x0152, replacement, 0x017D, replacement,  //
    replacement, 0x2018,      0x2019, 0x201C, 0x201D, 0x2022,      0x2013, 0x2014,       //
    0x02DC,      0x2122,      0x0161, 0x203A, 0x0153, replacement, 0x017E, 0x0178};

bool is_ascii(const std::string_view text)
{
  std::size_t i = 0;
  for (std::uint64_t word = 0; i + sizeof word <= text.size(); i += sizeof word) {
    std::memcpy(&word, text.data() + i, sizeof word);
    if (word & 0x8080808080808080u)
      return false;
  }
  return std::none_of(text.begin() + std::ptrdiff_t(i), text.end(),
                      [](const char c) { return static_cast<unsigned char>(c) >= 0x80; });
}
}  // namespace

bool is_utf8(const std::string_view text)
{
  if (is_ascii(text))
    return true;
  for (std::size_t position = 0; position < text.size();) {
    char32_t code       = 0;
    const std::size_t n = utf8_length(text, position, code);
    if (n == 0)
      return false;
    position += n;
  }
  return true;
}

void append_utf8(std::string &text, char32_t code)
{
  if (code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF))
    code = replacement;
  const auto tail = [&](const int shift) { text += char(0x80 | (code >> shift & 0x3F)); };
  if (code < 0x80) {
    text += char(code);
  } else if (code < 0x800) {
    text += char(0xC0 | code >> 6);
    tail(0);
  } else if (code < 0x10000) {
    text += char(0xE0 | code >> 12);
    tail(6);
    tail(0);
  } else {
    text += char(0xF0 | code >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

std::string valid_text(const std::string_view text)
{
  if (is_utf8(text))
    return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(result, byte >= 0x80 && byte < 0xA0 ? western[byte - 0x80] : byte);
  }
  return result;
}

std::optional<TextEncoding> utf16_of_mark(const std::string_view begin)
{
  if (begin.rfind("\xFF\xFE", 0) == 0)
    return TextEncoding::utf16_little;
  if (begin.rfind("\xFE\xFF", 0) == 0)
    return TextEncoding::utf16_big;
  return std::nullopt;
}

std::string valid_file_text(std::string bytes, TextEncoding &encoding)
{
  encoding = TextEncoding::utf8;
  if (const auto utf16 = utf16_of_mark(bytes)) {
    encoding = *utf16;
    std::string text;
    Utf16Decoder(*utf16 == TextEncoding::utf16_little)
        .append(text, std::string_view(bytes).substr(utf16_mark_size));
    return text;
  }
  if (is_utf8(bytes))
    return bytes;
  encoding = TextEncoding::windows_1252;
  std::string text;
  for (std::size_t position = 0; position < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', position), bytes.size() - 1) + 1;
    text += valid_text(std::string_view(bytes).substr(position, end - position));
    position = end;
  }
  return text;
}

void Utf16Decoder::append(std::string &text, const std::string_view bytes)
{
  rest.append(bytes);
  std::size_t i = 0;
  for (; i + 1 < rest.size(); i += 2) {
    const auto first = static_cast<unsigned char>(rest[i]), second = static_cast<unsigned char>(rest[i + 1]);
    const char32_t unit = little ? first | char32_t(second) << 8 : second | char32_t(first) << 8;
    const bool is_low   = unit >= 0xDC00 && unit < 0xE000;
    if (high_surrogate && is_low)
      append_utf8(text, 0x10000 + ((high_surrogate - 0xD800) << 10) + (unit - 0xDC00));
    else if (high_surrogate)
      append_utf8(text, replacement);
    const bool is_high = unit >= 0xD800 && unit < 0xDC00;
    if (!is_high && !(high_surrogate && is_low))
      append_utf8(text, unit);
    high_surrogate = is_high ? unit : 0;
  }
  rest.erase(0, i);
}
}  // namespace mill
