#pragma once
#include "core/model/lumped_model.h"
#include <map>
#include <string>

namespace mill {
struct Case;

/// Errors of the springs and masses of a chain before any record is used.
struct StatedErrors {
  std::map<std::string, double> error;  ///< -, relative; "K1" .. "K7", "M1" .. "M6" whose error is stated
  std::string source;                   ///< "the run in out/stand"; empty: the value itself states it
};

/// Of a four-high stand: the errors that its last run states for this very case, with the difference between the
/// run's value and that of the chain.  Without such a run: the intervals of the estimated values and the
/// tolerances of [frame], as far as they move each spring and mass; 5 % more for computed springs, since contact
/// laws differ by that.  Of other kinds: the errors of the given values.
/// @param chain  of the case at `load`
/// @param load   N
/// Cost: 20 ms for each estimate and each tolerance.
StatedErrors stated_errors(const Case &the_case, const LumpedModel &chain, double load);
}  // namespace mill
