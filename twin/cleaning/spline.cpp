#include "twin/cleaning/spline.h"
#include "core/base/require.h"
#include <algorithm>
#include <vector>

namespace mill::twin {
namespace {
constexpr Eigen::Index block = 1 << 15, overlap = 48;  // nodes

// Second derivatives at the nodes of one block, zero at its ends.
std::vector<double> curvatures(const Eigen::Ref<const Eigen::VectorXd> &x,
                               const Eigen::Ref<const Eigen::VectorXd> &y)
{
  const Eigen::Index m = x.size();
  std::vector<double> second(std::size_t(m), 0.0), upper(std::size_t(m), 0.0);
  for (Eigen::Index i = 1; i + 1 < m; ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double right     = 6 * ((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
    const double pivot     = 2 * (before + after) - before * upper[std::size_t(i - 1)];
    upper[std::size_t(i)]  = after / pivot;
    second[std::size_t(i)] = (right - before * second[std::size_t(i - 1)]) / pivot;
  }
  for (Eigen::Index i = m - 2; i >= 1; --i)
    second[std::size_t(i)] -= upper[std::size_t(i)] * second[std::size_t(i + 1)];
  return second;
}
}  // namespace

Eigen::VectorXd spline_on_grid(const Eigen::Ref<const Eigen::VectorXd> &x,
                               const Eigen::Ref<const Eigen::VectorXd> &y, const double x0, const double step,
                               const Eigen::Index n)
{
  const Eigen::Index m = x.size();
  require(m >= 2 && y.size() == m, "a spline goes through two points at least");
  Eigen::VectorXd values(n);
  Eigen::Index next = 0;
  for (Eigen::Index first = 0; first < m - 1 && next < n; first += block) {
    const Eigen::Index last = std::min(first + block, m - 1);  // intervals first .. last - 1 are worked off here
    const Eigen::Index from = std::max<Eigen::Index>(0, first - overlap), to = std::min(last + overlap, m - 1);
    const auto bx = x.segment(from, to - from + 1), by = y.segment(from, to - from + 1);
    const auto second = curvatures(bx, by);
    Eigen::Index i    = first - from;
    for (; next < n; ++next) {
      const double target = x0 + step * double(next);
      if (target > x[last] && last < m - 1)
        break;
      while (i + 1 < last - from && target > bx[i + 1])
        ++i;
      const double h = bx[i + 1] - bx[i], a = (bx[i + 1] - target) / h, b = (target - bx[i]) / h;
      values[next] =
          a * by[i] + b * by[i + 1] +
          ((a * a * a - a) * second[std::size_t(i)] + (b * b * b - b) * second[std::size_t(i + 1)]) * h * h / 6;
    }
  }
  return values;
}
}  // namespace mill::twin
