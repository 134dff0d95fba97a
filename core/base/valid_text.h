#pragma once
#include "core/base/choice.h"
#include <optional>
#include <string>
#include <string_view>

namespace mill {
/// Is every byte part of a UTF-8 character (RFC 3629)?  Cost O(n).
bool is_utf8(std::string_view text);

/// Appends one character.
/// @param code  of Unicode; what is not a character becomes U+FFFD
void append_utf8(std::string &text, char32_t code);

/// Text from outside (a name in a file, an option) as UTF-8: this is the only place where it is made valid.
/// Text that is not UTF-8 is read as Windows-1252, which contains the printable part of Latin-1; the five bytes
/// that Windows-1252 does not use become U+FFFD.
std::string valid_text(std::string_view text);

enum class TextEncoding { utf8, utf16_little, utf16_big, windows_1252 };
constexpr auto words_of(TextEncoding)
{
  return choice_words<TextEncoding>("UTF-8", "UTF-16 little endian", "UTF-16 big endian", "Windows-1252");
}

/// Bytes of a byte-order mark of UTF-16.
constexpr std::size_t utf16_mark_size = 2;

/// The UTF-16 whose byte-order mark begins the text; nothing without one.
std::optional<TextEncoding> utf16_of_mark(std::string_view begin);

/// A whole text file as UTF-8: UTF-16 with a byte-order mark is converted, every other line as in valid_text().
/// @param encoding  what the file is in
std::string valid_file_text(std::string bytes, TextEncoding &encoding);

/// Converts UTF-16 piece by piece.
class Utf16Decoder {
public:
  explicit Utf16Decoder(const bool is_little_endian) : little(is_little_endian) {}
  /// Appends the characters of these bytes; half a character at their end waits for the next call.
  void append(std::string &text, std::string_view bytes);

private:
  bool little;
  std::string rest;
  char32_t high_surrogate = 0;  // 0: none waits
};
}  // namespace mill
