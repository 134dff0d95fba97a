#pragma once

// Differences to compare exact derivatives with.
/// (f(1 + e) - f(1 - e))/(2 e) from two steps, without its error of second order.
template <class F> double difference(const F &f, const double e)
{
  const double one = (f(1 + e) - f(1 - e)) / (2 * e), two = (f(1 + 2 * e) - f(1 - 2 * e)) / (4 * e);
  return (4 * one - two) / 3;
}
