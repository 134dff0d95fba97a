#pragma once
#include <string>
#include <vector>

namespace mill {
/// A value that no drawing gave: by a formula or a rule of thumb from what is known.
struct Estimate {
  std::string key;                ///< "backup_roll.chock_mass_upper"
  double value = 0;               ///< SI
  double low   = 0;               ///< SI, lower end of where it is to be expected
  double high  = 0;               ///< SI, upper end
  std::string unit;               ///< of the key's row, "kg"
  std::string rule;               ///< one sentence with the number of the equation
  std::vector<std::string> from;  ///< keys that it was made from
  std::string source = {};        ///< what moves it together with others, "section of the posts"; empty: nothing
};
using Estimates = std::vector<Estimate>;

/// -, half the interval over the value.
inline double half_width(const Estimate &e)
{
  return 0.5 * (e.high - e.low) / e.value;
}
}  // namespace mill
