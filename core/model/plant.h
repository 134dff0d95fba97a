#pragma once
#include <limits>

namespace mill {
/// [plant]: what surrounds the stand and is seen in its records.
struct Plant {
  double mains = std::numeric_limits<double>::quiet_NaN();  ///< Hz; NaN: not given, 50 and 60 Hz are tried
};
}  // namespace mill
