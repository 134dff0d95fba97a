#pragma once
#include "twin/advice/advice_files.h"

namespace mill {
struct Case;

/// What would raise the critical speed of a pass of a cluster: springs of contacts and supports, damping, the
/// pass.
/// @throws InputError  no pass says enough for a search: which keys are missing
twin::AdviceRecord cluster_advice(const Case &the_case, int threads);
}  // namespace mill
