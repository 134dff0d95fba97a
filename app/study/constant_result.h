#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace mill {
/// Does a result have the same value in every row, but for rounding?  It has no variance to share among the
/// inputs.
inline bool is_constant(const std::vector<double> &values)
{
  constexpr double rounding = 1e-12;  // -, of a sum over some thousand terms
  const auto [least, most]  = std::minmax_element(values.begin(), values.end());
  return values.empty() || !(*most - *least > rounding * std::max(std::abs(*least), std::abs(*most)));
}
}  // namespace mill
