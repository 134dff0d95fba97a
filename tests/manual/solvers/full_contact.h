#pragma once
#include "fem/body/elastic_body.h"
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// Contact of two squeezed bodies solved on the full stiffness matrices, one sparse factorisation per active set:
/// what a general program does for every load.  Slow on purpose and independent of the condensation: it is the
/// check of it.
struct FullContact {
  double force = 0;       ///< N, sum of the nodal forces
  Eigen::VectorXd nodal;  ///< (n) N, on the patch in grid order (by z, then x)
  int iterations = 0;
};

/// @param gap   (n) m, initial gap at the patch nodes in grid order
/// @param q     m, imposed approach of the two axes
/// @param slab  both faces held in z (plane strain)
FullContact solve_full_contact(const ElasticBody &first, const ElasticBody &second, const Eigen::VectorXd &gap,
                               double q, bool slab);
}  // namespace mill::fem
