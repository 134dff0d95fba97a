#pragma once
#include <string>
#include <vector>

namespace mill::twin {
/// A roll of the stand by its name in channels and results.
struct TurningRoll {
  std::string name;  ///< "work_roll"
  double diameter;   ///< m
};

/// What a frequency at a speed leaves on strip and rolls.  theory.md (41.11)
struct MarkSpacing {
  double spacing;  ///< m, v / f
  struct Waves {
    std::string roll;
    double waves;         ///< -, per turn of the roll, pi D f / v
    double from_whole;    ///< -, distance to the nearest whole number
    double below, above;  ///< Hz, neighbouring frequencies with whole numbers of waves
  };
  std::vector<Waves> rolls;
};
MarkSpacing mark_spacing(double frequency, double speed, const std::vector<TurningRoll> &rolls);
}  // namespace mill::twin
