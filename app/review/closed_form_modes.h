#pragma once
#include "app/trace/closed_form_parts.h"
#include <vector>

namespace mill {
struct FourHigh;

/// Springs, masses and modes of the chain of a stand by closed forms at one load; no response is driven.
/// @throws InputError, SolverError  as closed_form_chain
std::vector<ClosedFormResult> closed_form_stand(FourHigh stand, double load);
}  // namespace mill
