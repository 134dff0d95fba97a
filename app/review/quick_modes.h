#pragma once
#include "app/trace/quick_parts.h"
#include <vector>

namespace mill {
struct FourHigh;

/// Springs, masses and modes of the chain of a stand by closed forms at one load; no response is driven.
/// @throws InputError, SolverError  as quick_chain
std::vector<QuickResult> quick_stand(FourHigh stand, double load);
}  // namespace mill
