#pragma once
#include <string>

// Pieces of a table.  Arguments named as HTML are taken as they are, the others are escaped.
namespace mill::report {
/// A cell of a number, aligned to the right; HTML.
std::string cell(const std::string &html);

/// The opening of a row with its name as head; cells and the end of the row follow.
std::string row_head(const std::string &name);

/// A whole row.
/// @param cells  HTML
std::string named_row(const std::string &name, const std::string &cells);

/// A table of the cells of its head and of its rows, HTML both; empty without rows.
std::string table_of(const std::string &head, const std::string &rows);

/// " (+3 %)", how far a value is from a reference, small; empty where one of them is not known or the reference is
/// zero.  HTML.
std::string deviation_note(double value, double reference);
}  // namespace mill::report
