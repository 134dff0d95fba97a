#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace mill {
/// Force over compression of springs of the six-mass chain, in place of their slopes: pairs of N and m, both
/// increasing from above zero; empty: the spring is linear.
struct ChainCurves {
  using Curve = std::vector<std::array<double, 2>>;
  Curve K2, K3, K4, K5, K6;

  bool any() const
  {
    return !(K2.empty() && K3.empty() && K4.empty() && K5.empty() && K6.empty());
  }
  /// By the number of the spring, 2 to 6.
  const Curve &of(const int spring) const
  {
    const std::array<const Curve *, 5> all{&K2, &K3, &K4, &K5, &K6};
    return *all[std::size_t(spring - 2)];
  }
};
}  // namespace mill
