#include "twin/calibration/hann_window.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr Eigen::Index window_reach = 6, parts = 4;  // bins on either side, steps of a bin
}

BandRecord fine_grid(const double bin, const Eigen::Index first, const Eigen::Index bins)
{
  BandRecord fine;
  const Eigen::Index k = (bins - 1) * parts + 2 * window_reach * parts + 1;
  fine.angular         = Eigen::VectorXd::NullaryExpr(k, [&](const Eigen::Index q) {
    return std::max(1e-3, bin * (double(first) + double(q - window_reach * parts) / parts));
  });
  fine.force           = Eigen::VectorXcd::Ones(k);
  return fine;
}

Eigen::VectorXd hann_weights()
{
  Eigen::VectorXd w(2 * window_reach * parts + 1);
  for (Eigen::Index q = 0; q < w.size(); ++q) {
    const double x    = double(q - window_reach * parts) / parts;
    const double sinc = x == 0 ? 1 : std::sin(M_PI * x) / (M_PI * x);
    const double W    = std::abs(std::abs(x) - 1) < 1e-12 ? 0.5 : sinc / (1 - x * x);
    w[q]              = W * W;
  }
  return w / w.sum();
}

Eigen::VectorXcd seen_through(const Eigen::VectorXcd &fine, const Eigen::VectorXd &weights,
                              const Eigen::Index bins)
{
  Eigen::VectorXcd out(bins);
  for (Eigen::Index b = 0; b < bins; ++b)
    out[b] = (fine.segment(b * parts, weights.size()).array() * weights.array()).sum();
  return out;
}
}  // namespace mill::twin
