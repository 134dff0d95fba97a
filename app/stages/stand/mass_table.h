#pragma once
#include "core/records/results.h"
#include <string>

namespace mill {
/// M1..M6 by every method and the published values, as `millstand masses` prints them; empty without M2.
std::string mass_table(const Results &results);
}  // namespace mill
