#pragma once
#include "report/page/run.h"
#include <string>

namespace mill::report {
/// The two contacts that a pair of bodies is asked for.
inline constexpr const char *pair_contacts[] = {"line", "space"};

/// The numbers that a mill is judged by, one card each.  HTML; empty where the run has none.
std::string cards(const Run &run);

/// Of a result that has a finite value; nullptr has none.
bool has_value(const Result *result);

/// "5142 kN/mm" with the digits that the error allows.
std::string shown(const Result &result, int digits = 4);
}  // namespace mill::report
