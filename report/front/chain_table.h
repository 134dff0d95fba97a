#pragma once
#include "report/page/run.h"
#include <string>

namespace mill::report {
/// K1 .. K7, Kzc of each bearing and M1 .. M6 with unit, error and origin: three small tables next to each other.
/// Empty without a chain.
std::string chain_table(const Run &run);
}  // namespace mill::report
