#pragma once
#include <cmath>
#include <vector>

namespace mill {
/// n values from the first to the last, evenly spaced in the logarithm.
/// @param n            at least 2
/// @param first, last  above 0, in one unit
inline std::vector<double> evenly_in_logarithm(const double first, const double last, const int n)
{
  std::vector<double> values;
  for (int i = 0; i < n; ++i)
    values.push_back(first * std::pow(last / first, double(i) / (n - 1)));
  return values;
}
}  // namespace mill
