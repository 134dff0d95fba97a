#include "reduce/stack/block_tridiagonal.h"
#include <utility>

namespace mill::reduce {
using Eigen::Index;
using Eigen::MatrixXd;

BlockTridiagonal::BlockTridiagonal(std::vector<Index> starts) : first(std::move(starts))
{
  const std::size_t blocks = first.size() - 1;
  block_of.resize(std::size_t(size()));
  for (std::size_t k = 0; k < blocks; ++k) {
    const Index n = first[k + 1] - first[k];
    std::fill(block_of.begin() + first[k], block_of.begin() + first[k + 1], int(k));
    diagonal.push_back(MatrixXd::Zero(n, n));
    if (k + 1 < blocks)
      below.push_back(MatrixXd::Zero(first[k + 2] - first[k + 1], n));
  }
}

void BlockTridiagonal::set_zero()
{
  for (MatrixXd &block : diagonal)
    block.setZero();
  for (MatrixXd &block : below)
    block.setZero();
}

void BlockTridiagonal::add(const Index i, const Index j, const double value)
{
  const auto row = std::size_t(block_of[std::size_t(i)]), column = std::size_t(block_of[std::size_t(j)]);
  (row == column ? diagonal[row] : below[column])(i - first[row], j - first[column]) += value;
}

Eigen::VectorXd BlockTridiagonal::times(const Eigen::VectorXd &x) const
{
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    const Index n = diagonal[k].rows();
    y.segment(first[k], n) += diagonal[k].selfadjointView<Eigen::Lower>() * x.segment(first[k], n);
    if (k < below.size()) {
      const Index m = below[k].rows();
      y.segment(first[k + 1], m) += below[k] * x.segment(first[k], n);
      y.segment(first[k], n) += below[k].transpose() * x.segment(first[k + 1], m);
    }
  }
  return y;
}

bool BlockTridiagonal::factorise()
{
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    Eigen::LLT<Eigen::Ref<MatrixXd>> factor(diagonal[k]);
    if (factor.info() != Eigen::Success)
      return false;
    if (k < below.size()) {
      factor.matrixU().solveInPlace<Eigen::OnTheRight>(below[k]);
      diagonal[k + 1].selfadjointView<Eigen::Lower>().rankUpdate(below[k], -1);
    }
  }
  return true;
}

void BlockTridiagonal::forward(Eigen::Ref<MatrixXd> B, const Index from) const
{
  for (auto k = std::size_t(block_of[std::size_t(from)]); k < diagonal.size(); ++k) {
    auto here = B.middleRows(first[k], diagonal[k].rows());
    diagonal[k].triangularView<Eigen::Lower>().solveInPlace(here);
    if (k < below.size())
      B.middleRows(first[k + 1], below[k].rows()).noalias() -= below[k] * here;
  }
}

void BlockTridiagonal::backward(Eigen::Ref<MatrixXd> B) const
{
  for (std::size_t k = diagonal.size(); k-- > 0;) {
    auto here = B.middleRows(first[k], diagonal[k].rows());
    if (k < below.size())
      here.noalias() -= below[k].transpose() * B.middleRows(first[k + 1], below[k].rows());
    diagonal[k].triangularView<Eigen::Lower>().transpose().solveInPlace(here);
  }
}
}  // namespace mill::reduce
