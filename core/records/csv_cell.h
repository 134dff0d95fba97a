#pragma once
#include <string>

namespace mill {
/// A text as a cell of CSV: between quotation marks (quoted_cell) where it holds a comma, a quotation mark or a
/// hidden character, which is then written out as "\x1b" (core/base/hidden_characters.h).
std::string csv_cell(const std::string &text);
}  // namespace mill
