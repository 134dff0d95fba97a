#include "report/plot/envelope.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::report {
namespace {
struct Extremes {
  Eigen::Index smallest, largest;
};

Extremes extremes(const Eigen::VectorXd &y, const Eigen::Index first, const Eigen::Index end)
{
  Extremes extremes{first, first};
  for (Eigen::Index i = first; i < end; ++i) {
    if (y[i] < y[extremes.smallest] || std::isnan(y[extremes.smallest]))
      extremes.smallest = i;
    if (y[i] > y[extremes.largest] || std::isnan(y[extremes.largest]))
      extremes.largest = i;
  }
  return extremes;
}
}  // namespace

std::vector<Eigen::Index> envelope(const Eigen::VectorXd &x, const Eigen::VectorXd &y, const double column_width)
{
  std::vector<Eigen::Index> kept;
  const auto column = [&](const Eigen::Index i) { return std::floor(x[i] / column_width); };
  for (Eigen::Index first = 0, end = 0; first < x.size(); first = end) {
    while (end < x.size() && column(end) == column(first))
      ++end;
    const auto [smallest, largest] = extremes(y, first, end);
    std::array<Eigen::Index, 4> four{first, smallest, largest, end - 1};
    std::sort(four.begin(), four.end());
    kept.insert(kept.end(), four.begin(), std::unique(four.begin(), four.end()));
  }
  return kept;
}

Eigen::VectorXd interval_extremes(const Eigen::VectorXd &y, const Eigen::Index n_intervals)
{
  if (y.size() <= 2 * n_intervals)
    return y;
  Eigen::VectorXd drawn(2 * n_intervals);
  for (Eigen::Index k = 0; k < n_intervals; ++k) {
    const auto [smallest, largest] = extremes(y, k * y.size() / n_intervals, (k + 1) * y.size() / n_intervals);
    drawn[2 * k]                   = y[std::min(smallest, largest)];
    drawn[2 * k + 1]               = y[std::max(smallest, largest)];
  }
  return drawn;
}
}  // namespace mill::report
