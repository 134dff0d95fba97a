#pragma once
#include "report/page/run.h"
#include <vector>

namespace mill::report {
/// Critical speeds of a run, the worst first: what run.json states; of a run that searched conditions (kind and
/// verb chatter) made from its results.
std::vector<SpeedVerdict> speed_verdicts(const Run &run);
}  // namespace mill::report
