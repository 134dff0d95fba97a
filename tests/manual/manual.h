#pragma once
#include "tests/manual/check/check_text.h"

// The verification manual as text: for the console and for docs/verification.md.
namespace mill::verify {
/// A case that has been run.
struct Outcome {
  Case page;
  std::vector<Check> checks;
  double seconds = 0;    ///< s, wall time of the run
  std::string error;     ///< what stopped it; empty when it ran to the end
  std::string skipped;   ///< what it needs and this machine has not; empty when it was run
  std::string ran_with;  ///< Case::ran_with, after the run
};

/// There is a check, none fails, and nothing stopped the case or made it be skipped.
bool passes(const Outcome &outcome);

/// "pass", "known deviation" (passes, with such a check), "reported" (passes, nothing is judged), "FAIL",
/// "skipped".
std::string verdict_text(const Outcome &outcome);

/// Runs a case; an exception becomes Outcome::error (or skipped), so that the others still run.
Outcome run(const Case &page);

/// Cases of these names, or of these families, in the order of the names; all of them for no name.
/// @throws InputError  a name that is not there, with the nearest one that is
std::vector<Case> select(const std::vector<Case> &all, const std::vector<std::string> &names);

/// Name, kind and the first sentence of each case, one line each.
std::string list_text(const std::vector<Case> &cases);

/// One case for the console: problem, a row per check (quantity, result, unit, reference, deviation, tolerance,
/// verdict), then reason, source and time.
std::string outcome_text(const Outcome &outcome);

/// "14 of 15 cases pass, 61 of 62 judged checks; 1 known deviation; 7 values compared with a reference, not
/// judged; skipped: peer-rolls; failed: cgs1-small", then what the skipped cases need.
std::string summary_text(const std::vector<Outcome> &outcomes);

/// Every known deviation with result, asked reference, cause and remedy; empty without any.
std::string known_text(const std::vector<Outcome> &outcomes);

/// docs/verification.md.  No times, and no digits of round-off, so that the page changes only when a result does.
std::string manual_page(const std::vector<Outcome> &outcomes);
}  // namespace mill::verify
