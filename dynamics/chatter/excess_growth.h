#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>

// Which roots of a stand grow, and which are on the imaginary axis up to rounding.  theory.md (25.9)
namespace mill::dynamics {
/// 1/s, real part less what rounding may make of it: an undamped mode that the bite does not reach is on the axis.
/// @param largest  1/s, modulus of the largest root
inline double excess_growth(const std::complex<double> root, const double largest)
{
  return root.real() - std::max(1e-9 * std::abs(root), 1e-13 * largest);
}

/// 1/s, the largest of them; above zero: vibration grows.
inline double excess_growth(const Eigen::VectorXcd &roots)
{
  const double largest = roots.cwiseAbs().maxCoeff();
  double excess        = -largest;
  for (const std::complex<double> &root : roots)
    excess = std::max(excess, excess_growth(root, largest));
  return excess;
}
}  // namespace mill::dynamics
