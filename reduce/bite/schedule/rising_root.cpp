#include "reduce/bite/schedule/rising_root.h"
#include "core/numerics/root_search.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
RisingRoot rising_root(const double low, const double high, const double wanted,
                       const std::function<double(double)> &function)
{
  constexpr double met_within = 1e-9;  // of the wanted value; the search ends far below it where there is no jump
  RisingRoot nearest;
  double least        = INFINITY;
  const auto distance = [&](const double x) {
    const double value = function(x), off = value - wanted;
    if (x == low || std::abs(off) < least) {
      nearest = {x, value, false};
      least   = std::abs(off);
    }
    return std::min(off, 1e3 * std::abs(wanted));  // the search takes finite numbers
  };
  root_between(low, high, distance);
  nearest.met = least <= met_within * std::abs(wanted);
  return nearest;
}
}  // namespace mill::bite
