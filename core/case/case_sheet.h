#pragma once
#include <string>

namespace mill {
/// A template filled from a sheet of rows "key, value[, unit]": `millstand new KIND --from sheet.csv`.
///
/// Separator comma, semicolon or tab (decimal commas with the latter two); quotes as in RFC 4180; byte-order mark,
/// CRLF, blank lines and lines that begin with # are understood, a first row "key, value" is skipped.  Keys are
/// full, "work_roll.barrel_diameter"; of [[pass]] "pass.load" is the first, "pass.1.load" the second; a bearing
/// has the name it stands under, "bearing.trb.bore".  The unit may stand in the value, "420 mm", or in the last
/// column.  The values of a pair or a list stand in one cell, parted by ';' or '|', "3.55 MN; 3.65 MN", or in
/// columns side by side; a unit behind the last one is that of all.  Where some number of the sheet has a decimal
/// comma, "1,230" has one too, and "1.230" is refused.
/// @throws InputError  every row that cannot be used in one go, with its line: unknown keys with the nearest one,
/// what
///                     the row of the key refuses, a key twice
std::string template_from_sheet(const std::string &kind, const std::string &file, const std::string &sheet);
}  // namespace mill
