#pragma once
#include "twin/onset/growth.h"
#include <complex>
#include <cstddef>
#include <vector>

namespace mill::twin {
/// Alarm and growth rate of one mode at one channel, value after value of its envelope.  theory.md (41.13),
/// (41.14) Memory: the last 60 s of the envelope.
class OnsetWatch {
public:
  /// @param frequency  Hz, of the band; @param rate  1/s, of the values
  OnsetWatch(double frequency, double rate, const AlarmSettings &settings);
  /// The next value; the alarm where it is one.  A value that is not a number ends the piece: restart().
  /// @param time  s, of the value.  Cost: 0.2 us, every fifth value 2 us for the median.
  std::optional<Alarm> take(double time, std::complex<double> z);
  /// Begins a new piece, as after a gap: no alarm before settings.least of baseline.
  void restart();
  /// Of a new piece: the baseline of before a gap or a restart of the program holds until the piece has its own.
  /// @param baseline  0-peak; not above zero: none
  void carry(double baseline);
  double level() const;               ///< 0-peak, of the last value; NaN: none
  double baseline() const;            ///< 0-peak; NaN: not enough of it yet
  bool above_half_threshold() const;  ///< an alarm that began is not over
  /// Over the last 60 s of this piece; sigma NaN below 8 s.  Cost: 0.4 ms.
  GrowthRate growth() const;

private:
  std::complex<double> before(std::size_t values) const;  // the value so many before the last
  void renew_baseline();
  double held_against() const;
  double slope_of_log() const;

  AlarmSettings rule;
  double band, rate_;
  std::size_t window, left_out, least, slope_values, kept_values;
  std::vector<std::complex<double>> ring;
  std::size_t taken         = 0;  // values of this piece
  std::size_t in_median     = 0;  // values of this piece that have entered `squares`
  std::size_t out_of_median = 0;  // and those that have left it
  std::vector<double> squares;    // of the baseline's window, ascending
  double baseline_ = 0, carried = 0;
  bool armed = true, above_before = false;
};
}  // namespace mill::twin
