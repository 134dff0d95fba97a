#include "reduce/bite/schedule/rising_root.h"
#include <cmath>

namespace mill::bite {
namespace {
constexpr double met_within = 1e-9;  // of the wanted value; the halving ends far below it where there is no jump

RisingRoot end_of(const double argument, const double value, const double wanted)
{
  return {argument, value, std::abs(value - wanted) <= met_within * std::abs(wanted)};
}
}  // namespace

RisingRoot rising_root(double low, double high, const double wanted, const std::function<double(double)> &function)
{
  double below = function(low) - wanted, above = function(high) - wanted;
  if (!(below < 0))
    return end_of(low, below + wanted, wanted);
  if (!(above > 0))
    return end_of(high, above + wanted, wanted);
  bool halve = false;
  for (int step = 0; step < 200; ++step) {
    const double width = high - low;
    double x           = 0.5 * (low + high);
    if (!halve && std::isfinite(above))
      x = low - below * width / (above - below);
    if (!(x > low && x < high))
      break;  // neighbouring numbers
    const double gap = function(x) - wanted;
    if (gap == 0)
      return end_of(x, wanted, wanted);
    if (gap < 0) {
      low   = x;
      below = gap;
    } else {
      high  = x;
      above = gap;
    }
    halve = !halve && high - low > 0.5 * width;  // a secant that moved one end by less than half
    if (high - low <= 2e-16 * std::abs(high))
      break;
  }
  return -below <= above ? end_of(low, below + wanted, wanted) : end_of(high, above + wanted, wanted);
}
}  // namespace mill::bite
