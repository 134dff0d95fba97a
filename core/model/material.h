#pragma once
#include <limits>

namespace mill {
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Elastic solid.
struct Material {
  double youngs_modulus = 210e9;      ///< Pa
  double poisson_ratio  = 0.28;       ///< -
  double density        = 7700;       ///< kg/m3
  double yield_stress   = not_given;  ///< Pa, of the rolls' surface
};
}  // namespace mill
