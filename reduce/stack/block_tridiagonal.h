#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace mill::reduce {
/// Symmetric positive definite matrix of dense blocks, each coupled with its neighbours only: beams that are
/// joined at common stations, station by station. Cost of a factorisation O(stations x block^3), of a solution
/// O(stations x block^2) a column.
class BlockTridiagonal {
public:
  /// @param first  (blocks + 1) first unknown of each block, and their number
  explicit BlockTridiagonal(std::vector<Eigen::Index> first);
  Eigen::Index size() const
  {
    return first.back();
  }
  void set_zero();
  /// Adds to the entry (i, j), i >= j, of the same or of neighbouring blocks; the other triangle is not stored.
  void add(Eigen::Index i, Eigen::Index j, double value);
  Eigen::VectorXd times(const Eigen::VectorXd &x) const;  ///< before factorise()
  /// In place.
  /// @return  false where the matrix is not positive definite
  bool factorise();
  /// L^-1 B in place, from the block of row `from` on; rows above are zero.
  void forward(Eigen::Ref<Eigen::MatrixXd> B, Eigen::Index from = 0) const;
  void backward(Eigen::Ref<Eigen::MatrixXd> B) const;  ///< L^-T B in place

private:
  std::vector<Eigen::Index> first;
  std::vector<int> block_of;
  std::vector<Eigen::MatrixXd> diagonal, below;  // below[k]: block (k + 1, k)
};
}  // namespace mill::reduce
