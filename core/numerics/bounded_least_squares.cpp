#include "core/numerics/bounded_least_squares.h"
#include <Eigen/QR>
#include <cmath>
#include <vector>

namespace mill {
using Eigen::Index;
using Eigen::VectorXd;

namespace {
// Moves the free unknowns towards their least squares, up to the first bound, which holds that unknown then.
// False where no bound was in the way.
bool meets_a_bound(const Eigen::MatrixXd &A, const VectorXd &b, const VectorXd &low, const VectorXd &high,
                   std::vector<char> &is_free, VectorXd &x)
{
  std::vector<Index> free;
  for (Index i = 0; i < x.size(); ++i)
    if (is_free[std::size_t(i)])
      free.push_back(i);
  if (free.empty())
    return false;
  const VectorXd step = A(Eigen::all, free).colPivHouseholderQr().solve(b - A * x);
  double share        = 1;
  Index first         = -1;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Index i     = free[k];
    const double room = step[Index(k)] > 0 ? high[i] - x[i] : low[i] - x[i];
    if (step[Index(k)] != 0 && room / step[Index(k)] < share) {
      share = room / step[Index(k)];
      first = i;
    }
  }
  for (std::size_t k = 0; k < free.size(); ++k)
    x[free[k]] += share * step[Index(k)];
  if (first < 0)
    return false;
  is_free[std::size_t(first)] = false;
  x[first]                    = x[first] - low[first] < high[first] - x[first] ? low[first] : high[first];
  return true;
}
}  // namespace

VectorXd bounded_least_squares(const Eigen::MatrixXd &A, const VectorXd &b, const VectorXd &low,
                               const VectorXd &high)
{
  const Index n = A.cols();
  VectorXd x    = VectorXd::Zero(n).cwiseMax(low).cwiseMin(high);
  std::vector<char> is_free(std::size_t(n), 1);
  const double small = 1e-12 * (A.transpose() * b).cwiseAbs().maxCoeff();
  for (int step = 0; step < 20 * int(n) + 20; ++step) {
    while (meets_a_bound(A, b, low, high, is_free, x)) {
    }
    // The unknown at a bound that would lessen |A x - b| most on its way back.
    const VectorXd downhill = A.transpose() * (b - A * x);
    Index best              = -1;
    for (Index i = 0; i < n; ++i)
      if (!is_free[std::size_t(i)] && low[i] < high[i] && (x[i] == low[i] ? downhill[i] : -downhill[i]) > small &&
          (best < 0 || std::abs(downhill[i]) > std::abs(downhill[best])))
        best = i;
    if (best < 0)
      break;
    is_free[std::size_t(best)] = true;
  }
  return x;
}
}  // namespace mill
