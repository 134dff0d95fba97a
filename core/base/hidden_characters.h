#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace mill {
/// Bytes of the UTF-8 character (RFC 3629) that begins there, and its number; 0 where none does.
std::size_t utf8_length(std::string_view text, std::size_t begin, char32_t &code);

/// Control characters, marks that turn the direction of writing, and the separators that end a line for some
/// readers.
bool is_hidden(char32_t code);

bool has_hidden(const std::string &text);

/// A text whose hidden characters are written in another way; bytes that are not UTF-8 stay.
std::string escaped(const std::string &text, const std::function<std::string(char32_t code)> &how);

/// "\x1b", "\u202e".
std::string number_of_character(char32_t code);
}  // namespace mill
