#pragma once
#include "tests/manual/check/verification.h"
#include <vector>

// A roller on one raceway: the plane rung below the roller in space, and the element of the product against it.
namespace mill::verify {
/// Approach (m) of the roller's diametral plane and a raceway held 12 mm behind it, plane strain, under the line
/// load q (N/m).  @param radius  m, of the raceway, > 0 convex, < 0 concave
double plane_approach(double radius, double q);

inline constexpr double roller_diameter = 21.5e-3, roller_length = 33.4e-3;  ///< m, of the roller of both studies

std::vector<Check> fe_2d_flat();
std::vector<Check> fe_2d_races();
std::vector<Check> fe_mesh_order();
}  // namespace mill::verify
