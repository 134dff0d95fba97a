#pragma once
#include <string>

namespace mill {
/// Text from a file or a command line as it may be shown on a terminal or in a log: control characters, marks that
/// turn the direction of writing and bytes that are not UTF-8 are written out, "\x1b", "\u202e"; all else stays.
/// Line feed and tab stay too, or are written out as well with `one_line`.  Names stand as the user wrote them
/// (with_plain_names()).
std::string visible(const std::string &text, bool one_line = false);
}  // namespace mill
