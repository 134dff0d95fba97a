#pragma once
#include "app/stages/bearing/bearing_results.h"
#include "core/records/csv.h"

namespace mill {
/// Published stiffnesses of one roller compared with the computed ones: at the load of the case, and the roller
/// loads at which the law of one roller fits them (NaN: at none up to 200 kN).  Empty without published values.
Table published_table(const BearingStudy &study);

/// Adds what links published per-roller values and total: the sums with Z/5 and with the factor that mechanics
/// gives, and the bearing loads at which tangent and secant take the published total.  Nothing without published
/// values.
void add_published_results(RunContext &run, const std::string &prefix, const BearingStudy &study,
                           const KeysOfRow &inputs);
}  // namespace mill
