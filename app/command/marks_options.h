#pragma once
#include <string>

namespace mill {
/// Flags of `millstand marks`, as written; empty: not given.
struct MarksOptions {
  std::string spacing;       ///< --spacing, "2 mm"
  std::string frequency;     ///< --frequency, "315 Hz", instead of the spacing
  std::string speed;         ///< --speed, "500 m/min"
  std::string forward_slip;  ///< --forward-slip, "3 %"
  std::string accuracy;      ///< --accuracy, "0.2 %"
  std::string side_bands;    ///< --side-bands, "49 Hz"
  std::string run;           ///< --run, folder whose modes are taken
};
}  // namespace mill
