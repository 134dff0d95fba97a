#pragma once
#include "tests/manual/check/verification.h"

// A check as text, for the console and for docs/verification.md.
namespace mill::verify {
/// What is printed of a check; a page that is out of date is found by comparing these with its cells.
struct CheckText {
  std::string quantity, result, unit, reference, deviation, tolerance, verdict;
};
CheckText check_text(const Check &check);

/// A known deviation of a case: its check, why it stands and what would end it.
struct KnownText {
  CheckText check;
  std::string cause, remedy;
  std::string
      moved;  ///< why it fails now: the result differs from the recorded one, or the check holds; else empty
};

/// Those of a case, in its order; failing ones too.
std::vector<KnownText> known_deviations(const std::vector<Check> &checks);

/// Text as the cell of a Markdown table, where a bar would end it.
std::string table_cell(std::string text);

/// The cells of a line "| a | b |" of such a table, as table_cell was given them; empty for any other line.
std::vector<std::string> cells_of_line(const std::string &line);
}  // namespace mill::verify
