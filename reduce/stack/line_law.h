#pragma once
#include "core/model/material.h"
#include <array>

namespace mill::reduce {
/// Line load of two cylinders over their approach, Johnson's law for both bodies with a ring in series.
/// theory.md (51.3), (51.4)
struct LineLaw {
  std::array<double, 2> radius     = {0, 0};  ///< m
  std::array<double, 2> compliance = {0, 0};  ///< 1/Pa, 2 (1 - nu^2) / (pi E) of each body
  double ring                      = 0;       ///< 1/Pa, 1 / k_ring
};

LineLaw line_law(double radius_a, const Material &a, double radius_b, const Material &b, double ring_stiffness);

/// Line load and its derivative at one approach; both zero where the rolls are apart.
struct LineLoad {
  double load    = 0;  ///< N/m
  double tangent = 0;  ///< Pa, d(load)/d(approach)
};

double approach_of(const LineLaw &law, double load);    ///< m, (51.3)
double compliance_of(const LineLaw &law, double load);  ///< 1/Pa, its derivative (51.4)
double half_width_of(const LineLaw &law, double load);  ///< m
/// Inverse of approach_of; converges to 1e-15 of the load within some five Newton steps.
LineLoad line_load(const LineLaw &law, double approach);
}  // namespace mill::reduce
