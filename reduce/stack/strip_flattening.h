#pragma once
#include "core/model/material.h"
#include <Eigen/Core>

namespace mill::reduce {
enum class Flattening { half_space, local };

/// A work roll under line loads that are constant in each element of the strip's width.
struct FlattenedRoll {
  Eigen::VectorXd edges;  ///< (n + 1) m, ends of the elements, increasing
  double radius = 0;      ///< m
  double arc    = 0;      ///< m, 2a, contact length in the rolling direction; the pressure is uniform across it
  Material material;
  Flattening law = Flattening::half_space;
};

/// How much it flattens towards its axis, mean from z1 to z2, per line load on each element: (n) 1/Pa.
/// theory.md (51.6), (51.7).  Source of the half space: A. E. H. Love, Phil. Trans. A 228 (1929) 377; the last
/// term of (51.7) makes a long uniform load return the plane law.
Eigen::VectorXd flattening_between(const FlattenedRoll &roll, double z1, double z2);
/// The same of every element, w = C q: (n, n) 1/Pa.  Cost O(n^2).
Eigen::MatrixXd flattening_matrix(const FlattenedRoll &roll);
}  // namespace mill::reduce
