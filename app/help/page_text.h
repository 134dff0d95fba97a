#pragma once
#include <string>
#include <vector>

namespace mill::help {
/// A page of docs/ for a terminal: paragraphs broken at 88 columns, blocks of commands and tables indented, of a
/// link its text.
std::string page_text(const std::string &markdown);

/// A paragraph without its marks (links, backticks stay), broken at 88 columns.
/// @param indent  blanks before each line
std::string paragraph(const std::string &markdown, int indent);

/// Cells of a row of a table, "| `K3` | contact |", without blanks around; empty when the line is not a row, or
/// the line of dashes below the head.
std::vector<std::string> cells_of(const std::string &line);
}  // namespace mill::help
