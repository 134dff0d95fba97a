#pragma once
#include "core/numerics/sparse.h"
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// Stiffness of a body in space without its held unknowns, and the way back.
struct FreeUnknowns {
  SymmetricSparse K;         ///< (n, n) upper triangle, N/m or as given
  std::vector<int> place;    ///< (unknowns of the body) row of K, -1: held
  std::vector<int> unknown;  ///< (n) of the body
  std::vector<int> node;     ///< (n) of the body
};

/// @param K     (3N, 3N) upper triangle
/// @param held  (3N) 1: held
FreeUnknowns free_unknowns(const SymmetricSparse &K, const std::vector<char> &held);

/// Rows and columns of C, zero where the index is -1: a held unknown.
Eigen::MatrixXd rows_and_columns(const Eigen::MatrixXd &C, const std::vector<int> &rows,
                                 const std::vector<int> &columns);
}  // namespace mill::fem
