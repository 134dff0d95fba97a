#pragma once
#include <cstdint>
#include <optional>

// Cumulative sums of standardised deviations: whether a mean has moved.  theory.md 50.5
namespace mill::twin {
struct CusumRule {
  double slack     = 0.5;  ///< standard deviations, k: half of the shift that is looked for
  double threshold = 12;   ///< standard deviations, h
};

/// An alarm: which way, and since when.
struct Shift {
  int sign;            ///< 1: upward, -1: downward
  std::int64_t since;  ///< number of the first value after the sum left zero for the last time
  std::int64_t taken;  ///< number of the value that raised the alarm
  double sum;          ///< standard deviations, above the threshold
  double mean;         ///< standard deviations, mean of the values since the change
};

/// Both one-sided sums.  Stays in alarm until restart().
class Cusum {
public:
  explicit Cusum(const CusumRule &rule = {});
  /// @param z  deviation over its standard deviation; not finite: not counted
  /// The first alarm of a sum.
  std::optional<Shift> take(double z);
  void restart();
  double upward() const;    ///< standard deviations, >= 0
  double downward() const;  ///< the same
  std::int64_t taken() const;
  /// What a restarted program goes on from.
  struct State {
    std::int64_t taken = 0, since_up = 0, since_down = 0;
    double up = 0, down = 0, sum_up = 0, sum_down = 0;
    bool alarm = false;
  };
  State state;

private:
  CusumRule rule;
};

/// Mean number of values to an alarm of one upward sum that starts at zero, of independent normal values of mean
/// `shift` (standard deviations) and variance one: the integral equation of Page, solved at 64 Gauss points.
/// theory.md (50.6); accurate to 1e-9 for thresholds up to 20.  Cost: one 64 x 64 system.
double cusum_run_length(double shift, const CusumRule &rule = {});
/// Of both sums together.  (50.7)
double two_sided_run_length(double shift, const CusumRule &rule = {});
/// Siegmund's closed form of the one-sided length.  (50.8)
double siegmund_run_length(double shift, const CusumRule &rule = {});
}  // namespace mill::twin
