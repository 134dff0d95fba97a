#pragma once
#include "verify/verification.h"

// The verification manual as text: for the console and for docs/verification.md.
namespace mill::verify {
/// A case that has been run.
struct Outcome {
  Case page;
  std::vector<Check> checks;
  double seconds = 0;  ///< s, wall time of the run
  std::string error;   ///< what stopped it; empty when it ran to the end
};

/// All checks pass, there is one, and nothing stopped the case.
bool passes(const Outcome &outcome);

/// Runs a case; an exception becomes Outcome::error, so that the others still run.
Outcome run(const Case &page);

/// Cases of these names, or of these families, in the order of the names; all of them for no name.
/// @throws InputError  a name that is not there, with the nearest one that is
std::vector<Case> select(const std::vector<Case> &all, const std::vector<std::string> &names);

/// Name, kind and the first sentence of each case, one line each.
std::string list_text(const std::vector<Case> &cases);

/// One case for the console: problem, a row per check (quantity, result, unit, reference, deviation, tolerance,
/// verdict), then reason, source and time.
std::string outcome_text(const Outcome &outcome);

/// "14 of 15 cases pass, 61 of 62 checks; failed: cgs1-small"
std::string summary_text(const std::vector<Outcome> &outcomes);

/// What is printed of a check; a page that is out of date is found by comparing these with its cells.
struct CheckText {
  std::string quantity, result, unit, reference, deviation, tolerance, verdict;
};
CheckText check_text(const Check &check);

/// Text as the cell of a Markdown table, where a bar would end it.
std::string table_cell(std::string text);

/// docs/verification.md.  No times, and no digits of round-off, so that the page changes only when a result does.
std::string manual_page(const std::vector<Outcome> &outcomes);
}  // namespace mill::verify
