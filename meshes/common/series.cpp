#include "meshes/common/series.h"
#include "core/numerics/root_search.h"
#include <algorithm>

namespace mill::meshes {
double ratio_filling(const double length, const double first, const int n)
{
  if (n == 1)
    return 1;
  constexpr double least = 1e-3;
  const double most      = std::max(1., std::pow(length / first, 1. / (n - 1)));  // the last element fills all
  return root_between(least, most, [&](const double ratio) { return sum_of(first, ratio, n) - length; })
      .value_or(least);
}
}  // namespace mill::meshes
