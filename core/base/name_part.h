#pragma once
#include <string>

namespace mill {
/// A name of the user as one part of the names of results, keys and files, whose parts '.' and '/' separate:
/// "2.0 mm/A" -> "2%2E0 mm%2FA".  Cost O(n).
std::string name_part(const std::string &name);

/// A text with the names in it as the user wrote them: the inverse of name_part() wherever it stands in the text.
std::string with_plain_names(const std::string &text);
}  // namespace mill
