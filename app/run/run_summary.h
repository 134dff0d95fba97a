#pragma once
#include "core/records/results.h"
#include <string>

namespace mill {
/// What a run says at its end, at most 25 lines: verdict, modulus, named modes, limits, warnings, page.  All
/// results are on the page and, with -v, in a table.
/// @param name     of the case
/// @param limits   sentences of the stages, a line each: critical speeds
/// @param page     path of the report
std::string run_summary(const Results &results, const std::string &name, const std::string &limits,
                        const std::string &page);

/// "4.02e+04 kN/mm", "38.9 Hz": a value as an engineer reads it.
std::string engineering(const Parameter &p);
}  // namespace mill
