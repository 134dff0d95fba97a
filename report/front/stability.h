#pragma once
#include "report/page/run.h"
#include <string>
#include <vector>

namespace mill::report {
/// Critical speeds of a run, the worst first: what run.json states; of a run that searched conditions (kind and
/// verb chatter) made from its results.
std::vector<SpeedVerdict> speed_verdicts(const Run &run);

/// "stand 5"; where the name is a number alone: "condition 3" (kind chatter), "pass 3".
std::string title_of_pass(const Run &run, const std::string &name);
}  // namespace mill::report
