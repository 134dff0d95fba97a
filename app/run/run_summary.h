#pragma once
#include "core/records/results.h"
#include <string>

namespace mill {
/// The last lines of a run on the console, at most 25: verdict, modulus, named modes, limits, warnings, page.  All
/// results are on the page and, with -v, in a table.
/// @param name     of the case
/// @param limits   sentences of the stages, a line each: critical speeds
/// @param page     path of the report
std::string run_summary(const Results &results, const std::string &name, const std::string &limits,
                        const std::string &page);

/// "40200 kN/mm", "38.9 Hz": a value in a common unit, with the digits that its error allows;
/// four where no error is stated, six of a number without unit.
std::string engineering(const Parameter &p);
}  // namespace mill
