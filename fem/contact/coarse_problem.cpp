#include "fem/contact/coarse_problem.h"
#include <algorithm>

namespace mill::contact {
namespace {
std::vector<std::vector<int>> neighbours(const Eigen::MatrixXd &C, const int size)
{
  const int n = int(C.rows());
  std::vector<int> left(n);
  for (int i = 0; i < n; ++i)
    left[i] = i;
  const Eigen::VectorXd per_root = C.diagonal().cwiseSqrt().cwiseInverse();
  std::vector<std::vector<int>> groups;
  while (!left.empty()) {
    const double *column = C.col(left.front()).data();
    const int count      = std::min(size, int(left.size()));
    // The seed first, it is its own closest neighbour.
    std::nth_element(left.begin() + 1, left.begin() + count - 1, left.end(),
                     [&](const int a, const int b) { return column[a] * per_root[a] > column[b] * per_root[b]; });
    groups.emplace_back(left.begin(), left.begin() + count);
    left.erase(left.begin(), left.begin() + count);
    std::sort(left.begin(), left.end());
  }
  return groups;
}
}  // namespace

CoarseProblem coarse_problem(const Problem &p, const int size)
{
  const auto groups = neighbours(p.C, size);
  const int n = int(p.C.rows()), m = int(groups.size());
  CoarseProblem out;
  out.group_of.resize(n);
  for (int g = 0; g < m; ++g)
    for (const int i : groups[g])
      out.group_of[i] = g;
  out.problem.C = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd sum(n);
  for (int g = 0; g < m; ++g) {
    sum.setZero();
    for (const int i : groups[g])
      sum += p.C.col(i);
    out.problem.C.col(g) = summed(out, sum);
  }
  const auto reduce = [&](const Eigen::MatrixXd &columns) {
    Eigen::MatrixXd reduced(columns.size() ? m : 0, columns.cols());
    for (int j = 0; j < columns.cols() && columns.size(); ++j)
      reduced.col(j) = summed(out, columns.col(j));
    return reduced;
  };
  out.problem.G           = reduce(p.G);
  out.problem.W           = reduce(p.W);
  out.problem.initial_gap = summed(out, p.initial_gap);
  return out;
}

Eigen::VectorXd summed(const CoarseProblem &coarse, const Eigen::VectorXd &values)
{
  Eigen::VectorXd out = Eigen::VectorXd::Zero(coarse.problem.C.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    out[coarse.group_of[i]] += values[i];
  return out;
}
}  // namespace mill::contact
