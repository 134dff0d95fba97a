#pragma once
#include <Eigen/Core>

namespace mill::cluster {
/// Collocation at the Gauss points of a step: x'' is a polynomial through its values there.  Order 2 s,
/// symplectic; the energy of a free motion does not drift.  theory.md (38.21)
struct Collocation {
  static constexpr int stages = 6;
  using Row                   = Eigen::Matrix<double, 1, stages>;
  using Square                = Eigen::Matrix<double, stages, stages>;

  Eigen::Matrix<double, stages, 1> c;  ///< -, points of the step, 0 .. 1
  Row b;                               ///< -, weights of an integral over the step
  Square A;                            ///< -, row i: integral up to point i
  Square AA;                           ///< -, twice
  Row bA;                              ///< -, over the step, of the integral
  Row last;  ///< -, coefficient of the highest Legendre polynomial of what stands at the points

  Collocation();
  Row up_to(double x) const;  ///< weights of the integral from 0 to x
};
}  // namespace mill::cluster
