#pragma once
#include "tests/manual/check/verification.h"
#include <vector>

namespace mill::verify {
/// Observed orders of convergence of displacement and pressure in L2 on a contact whose solution is known
/// everywhere.
std::vector<Check> order_quadratic();
}  // namespace mill::verify
