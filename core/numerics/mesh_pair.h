#pragma once
#include <cmath>

namespace mill {
/// Safety of an error that is known from one pair of meshes only.  theory.md 1.3, (1.5); P. J. Roache, J. Fluids
/// Eng. 116 (1994) 405: 1.25 where the order has been seen on three meshes, which the verification manual does for
/// each kind of mesh.
constexpr double mesh_pair_safety = 1.25;

/// The same where the order was not observed: largest values, whose place moves from mesh to mesh.
constexpr double unseen_order_safety = 3;

/// Gain of a method of second order on a mesh half as fine.
constexpr double second_order = 4;

/// Relative error of a value from a finer and a coarser mesh.
/// @param gain  -, how many times larger the error is on the coarser mesh: (ratio of element sizes)^order; 2 where
/// no
///              order is known of a mesh half as fine: the finer one then errs by no more than the difference
inline double mesh_pair_error(const double fine, const double coarse, const double gain = 2,
                              const double safety = mesh_pair_safety)
{
  return safety * std::abs(fine - coarse) / (std::abs(fine) * (gain - 1));
}
}  // namespace mill
