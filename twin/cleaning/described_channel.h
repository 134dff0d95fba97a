#pragma once
#include "twin/records/raw_record.h"
#include <optional>
#include <string>

namespace mill::twin {
/// A column that is not a vibration and is described instead of analysed.
struct DescribedChannel {
  std::string name, column, unit;
  std::string kind;        ///< "empty", "constant", "switch", "counter", "ramp", "set value"
  std::string sentence;    ///< "counter, step 1, from 0 to 11999"
  double lowest, highest;  ///< in `unit`; NaN where it is empty
};

/// Is this column a counter, a ramp, a constant, a switch or a set value?  Nothing where it may vibrate, and for a
/// speed, which may stand still.  A record of a vibration is never monotone, and never holds its value for 99 of
/// 100 samples.  Cost O(n).
std::optional<DescribedChannel> described(const RawChannel &channel);
}  // namespace mill::twin
