#include "twin/spectra/marks.h"
#include <cmath>

namespace mill::twin {
MarkSpacing mark_spacing(const double frequency, const double speed, const std::vector<TurningRoll> &rolls)
{
  MarkSpacing marks{speed / frequency, {}};
  for (const TurningRoll &roll : rolls) {
    const double circumference = M_PI * roll.diameter, waves = circumference * frequency / speed;
    marks.rolls.push_back({roll.name, waves, waves - std::round(waves), std::floor(waves) * speed / circumference,
                           (std::floor(waves) + 1) * speed / circumference});
  }
  return marks;
}
}  // namespace mill::twin
