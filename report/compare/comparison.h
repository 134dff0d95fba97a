#pragma once
#include "report/page/run.h"
#include <string>
#include <utility>
#include <vector>

// Comparison of runs: changed inputs, changed results, the same curves on the same axes.
namespace mill::report {
/// One input that the runs do not share.
struct ChangedInput {
  std::string key;                  ///< "work_roll.barrel_diameter"
  std::vector<std::string> values;  ///< (runs) as resolved.toml has them; empty: not there
};

/// The inputs in which the resolved cases differ, in the order of the first.
/// @param resolved  (runs) texts of resolved.toml
std::vector<ChangedInput> changed_inputs(const std::vector<std::string> &resolved);

/// How sure a difference is.  What is the same in both runs cancels in it.
enum class Certainty {
  certain,  ///< only given keys differ behind the result: the difference is what they do
  beyond,   ///< larger than the error that does not cancel
  within,   ///< not larger than it
  unknown,  ///< a run states no error where one is needed
};

/// One result that more than one run has and that is not the same in all.
struct ChangedResult {
  std::vector<const Result *> results;  ///< (runs) nullptr: that run has none
  double change       = 0;              ///< -, largest deviation from the first run, with its sign
  Certainty certainty = Certainty::unknown;
  double error        = 0;          ///< -, of `change`; NaN: not known
  std::vector<std::string> behind;  ///< keys that differ between the two runs and that the result is made from
};

/// Modulus, named modes and critical speeds first, then the others; the largest change first in either part.
/// Deviations below 1e-9 are rounding and are left out.
/// @param resolved  (runs) texts of resolved.toml.  The error of a difference: theory.md 34.5
std::vector<ChangedResult> changed_results(const std::vector<Run> &runs, const std::vector<std::string> &resolved);

/// The page that compares them, complete.
/// @param resolved  (runs) texts of resolved.toml, for what was changed
std::string comparison_page(const std::vector<Run> &runs, const std::vector<std::string> &resolved);

/// Is this text a page that comparison_page() made?  Then it may be replaced.
bool is_comparison_page(const std::string &text);

/// Reads the folders and makes the page.
/// @throws InputError  a folder that is not a run
std::string comparison_of(const std::vector<std::string> &directories);
}  // namespace mill::report
