#pragma once
#include <cmath>

namespace mill::meshes {
/// m, sum of n elements of which the first has the size `first` and each is `ratio` times the one before.
inline double sum_of(const double first, const double ratio, const int n)
{
  return ratio == 1 ? first * n : first * std::expm1(n * std::log(ratio)) / (ratio - 1);  // exact near ratio 1 too
}

/// Ratio with which n elements fill `length`; 1 where n is 1, which no ratio changes.
double ratio_filling(double length, double first, int n);
}  // namespace mill::meshes
