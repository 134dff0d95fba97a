#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::bearing {
/// Unsymmetric matrix with `width` diagonals on each side of the main one, factored in place without exchanging
/// rows: for the diagonally dominant matrices of a film.
class BandMatrix {
public:
  BandMatrix(Eigen::Index size, Eigen::Index width)
      : n(size), w(width), entries(std::size_t(size * (2 * width + 1)), 0.)
  {
  }
  /// Entry of row i and column j, which lies within the band.
  double &at(const Eigen::Index i, const Eigen::Index j)
  {
    return entries[std::size_t(i * (2 * w + 1) + j - i + w)];
  }
  void factor();
  /// Replaces a right-hand side by the solution; after factor().
  void solve(Eigen::Ref<Eigen::VectorXd> rhs) const;

private:
  Eigen::Index n, w;
  std::vector<double> entries;  // row by row
};
}  // namespace mill::bearing
