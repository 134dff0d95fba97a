#pragma once
#include "verify/verification.h"
#include <vector>

// Cylinders and discs in plane strain: what the cases of their names run.
namespace mill::verify {
std::vector<Check> cgs1_small();
std::vector<Check> cgs1_depth();
std::vector<Check> cattaneo_line_section();
std::vector<Check> line_200_650();
std::vector<Check> line_210_725();
std::vector<Check> disc_r10();
std::vector<Check> disc_r50();
}  // namespace mill::verify
