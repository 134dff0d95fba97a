#pragma once
#include "twin/onset/envelope.h"
#include <limits>
#include <optional>
#include <vector>

namespace mill::twin {
constexpr double near_instability_from = -0.5;  ///< 1/s, upper end of 95 % from which a mode is warned of

/// Growth rate of a mode from the correlation of its envelope: while a mill is calm, its distance to instability.
/// theory.md (41.13)
struct GrowthRate {
  double sigma = std::numeric_limits<double>::quiet_NaN();  ///< 1/s, negative: decays
  double law =
      std::numeric_limits<double>::quiet_NaN();  ///< 1/s, standard deviation, sqrt(|sigma|/T): a lower bound
  double duration  = 0;                          ///< s, T
  double frequency = 0;                          ///< Hz, of the mode; the rotation of the envelope is added
  double kept =
      0;  ///< -, correlation left at the first lag beyond the filter; below 0.3 the mode decays too fast for this
  double tone = 0;  ///< -, share of the mean square in steady tones that were taken off first, (41.18); 0: none
  bool near_instability() const;  ///< upper end of 95 % above -0.5 1/s
  double upper() const;           ///< 1/s, of the 95 % interval, by 1.6 times the law
  double lower() const;           ///< 1/s, of the same
};
GrowthRate growth_rate(const ComplexEnvelope &envelope);

/// Onset of chatter: the amplitude is above five baselines in two successive values.  theory.md (41.14)
struct Alarm {
  double time;      ///< s
  double level;     ///< 0-peak, unit of the channel
  double baseline;  ///< the same, of the 30 s before, without the last second
  double sigma;     ///< 1/s, over the last 0.2 s
  double to_limit;  ///< s until the limit at this growth; NaN: no limit given, or it decays
};
struct AlarmSettings {
  double threshold = 5;         ///< -, baselines
  double before    = 30;        ///< s, of the baseline
  double left_out  = 1;         ///< s, the last of them
  double least     = 5;         ///< s, of baseline before the first alarm
  std::optional<double> limit;  ///< unit of the channel, 0-peak
};
/// First values of each time that the level is exceeded; the next alarm needs it to fall below half first.
std::vector<Alarm> alarms(const ComplexEnvelope &envelope, const AlarmSettings &settings);

/// s, no such alarm leads the limit by more: ln(limit / threshold level) / sigma.
double longest_lead(double limit, double threshold_level, double sigma);
}  // namespace mill::twin
