#pragma once
#include "core/base/parameter.h"
#include "core/model/material.h"
#include "tests/manual/check/verification.h"
#include <vector>

// Cylinders and discs in plane strain: what the cases of their names run.
namespace mill::verify {
/// N/m, load with which two cylinders in plane strain, each balanced by an equal load on its opposite generator,
/// stand at an approach of their axes (m); meshed for contacts about as wide as half_width (m).
double line_load_at(double R1, double R2, const Material &material, double half_width, double approach);

std::vector<Check> cgs1_small();
std::vector<Check> cgs1_depth();
std::vector<Check> cattaneo_line_section();
std::vector<Check> line_200_650();
std::vector<Check> line_210_725();
std::vector<Check> disc_r10();
std::vector<Check> disc_r50();
}  // namespace mill::verify
