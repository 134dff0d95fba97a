#pragma once
#include "core/records/results.h"

namespace mill {
struct FourHigh;
struct RunContext;

/// Every estimate with what its interval moves in masses, springs and modes of the chain, the one that costs most
/// accuracy first: half the difference of the logarithms at both ends, by closed forms.  theory.md (34.11)
/// @param load  N, of the first pass
/// Cost: two evaluations of the closed forms for each estimate, some 10 ms each.
std::vector<EstimateRecord> ranked_estimates(const FourHigh &stand, double load);

/// Marks the results that hang on estimates, adds what those may move to their accuracy, and lists them.  Values
/// of the frame have done so through their tolerance; where no closed form is known, the result states no
/// accuracy.
void mark_estimates(RunContext &run);
}  // namespace mill
