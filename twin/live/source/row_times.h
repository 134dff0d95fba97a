#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace mill::live {
/// Samples per second of the times of some rows: the slope of the counter, rounded to the fewest digits that the
/// resolution of the times allows.  theory.md (48.9)
/// @param seconds  ascending but for slips, two at least
/// @throws InputError  fewer; one in a hundred of the times stands still
double rate_of_times(const std::vector<double> &seconds);

/// Times of the rows of a file that grows, compared with each other: a clock that jumps, a recorder that was set
/// to another rate.
class RowTimes {
public:
  /// Beyond these a time is not believed until the next row follows it.
  static constexpr double longest_jump   = 3600;  // s, ahead
  static constexpr double longest_return = 60;    // s, back

  /// s by which this row is away from where it should stand, when that is more than a jump; nothing otherwise.
  std::optional<double> jump(double seconds, double rate) const;
  /// Whether a row stands where the row after `before` should.
  static bool follows(double before, double seconds, double rate);
  /// Takes a row that is believed.
  /// @return samples per second, when the last rows stand apart by more than a twentieth more or less than before
  std::optional<double> take(double seconds, double rate);
  /// s, of the last row that was believed.
  std::optional<double> last() const
  {
    return last_;
  }
  void restart();

private:
  std::optional<double> last_;
  std::vector<double> seconds_;  // since the last look at the rate
};
}  // namespace mill::live
