#pragma once
#include "report/results/named_mode.h"
#include <string>

namespace mill::report {
/// The modes by the names they have in a rolling mill: frequency, what decided, the same in other models.  HTML;
/// empty when the run named none.
std::string named_mode_table(const Run &run);
}  // namespace mill::report
