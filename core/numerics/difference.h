#pragma once
#include <cmath>

namespace mill {
/// Relative difference |other / value - 1|: how far a second answer is from the first.
inline double difference(const double other, const double value)
{
  return std::abs(other / value - 1);
}

/// A relative error that covers a second answer too.
/// @param error  -, NaN: not known before
/// @param other  NaN: not computed, the error stays
inline double widened(const double error, const double other, const double value)
{
  return std::isnan(other) ? error : std::fmax(error, difference(other, value));
}
}  // namespace mill
