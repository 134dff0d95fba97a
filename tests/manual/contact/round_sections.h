#pragma once
#include "tests/manual/check/verification.h"
#include <vector>

// Bodies of revolution: what the cases of their names run.
namespace mill::verify {
std::vector<Check> sphere_flat();
std::vector<Check> sphere_sphere();
std::vector<Check> flat_punch();
}  // namespace mill::verify
