#pragma once
#include "twin/advice/advice_files.h"

namespace mill {
struct Case;

/// Advice on the critical speed of a condition of a case of kind chatter, as its [advice] asks for it.
/// @throws InputError, SolverError  no steady bite at the working speed, none in the range searched
twin::AdviceRecord critical_speed_advice(const Case &the_case, int threads);
}  // namespace mill
