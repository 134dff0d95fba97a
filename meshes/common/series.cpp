#include "meshes/common/series.h"
#include "core/numerics/root_search.h"
#include <algorithm>
#include <limits>

namespace mill::meshes {
double ratio_filling(const double length, const double first, const int n)
{
  if (n == 1)
    return 1;
  constexpr double least = 1e-3;
  const double most      = std::max(1., std::pow(length / first, 1. / (n - 1)));  // the last element fills all
  const auto missing     = [&](const double ratio) {  // term by term: the closed form cancels near ratio 1
    double rest = length, element = first;
    for (int i = 0; i < n; ++i, element *= ratio)
      rest -= element;
    return rest;
  };
  // To neighbouring numbers: the lines of two meshes whose sizes differ by rounding differ by rounding.
  return root_between(least, most, missing, std::numeric_limits<double>::epsilon()).value_or(least);
}
}  // namespace mill::meshes
