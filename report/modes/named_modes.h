#pragma once
#include "report/results/named_mode.h"
#include <string>

namespace mill::report {
/// The modes that the gap or a sensor sees by the names they have in a rolling mill: frequency with the strip
/// between the rolls and without it, share of the gap's compliance, what decided, the same in other models.  HTML;
/// empty when the run named none.
std::string named_mode_table(const Run &run);

/// The other modes below the frequency limit, folded and counted.  HTML; empty without the models of a stand.
std::string folded_modes(const Run &run);
}  // namespace mill::report
