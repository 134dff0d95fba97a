#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace mill::live {
/// Both clocks of this machine at one moment.
struct ClockReading {
  double steady = 0;  ///< s, never set
  double utc    = 0;  ///< s since 1970, may be set
};

/// When the rate or the clock of a source is judged wrong.
struct ArrivalRule {
  double window    = 20;    ///< s, that a rate is measured over, longer where blocks are long
  double tolerance = 0.02;  ///< -, of the stated rate
  int in_a_row  = 3;  ///< windows with the same deviation before it is reported, or without one before it is over
  double played = 3;  ///< times the stated rate: a record that is played, no rate that is wrong
  double jump   = 2;  ///< s, of a clock or of the numbers
  double behind = 0.5;  ///< s of samples that wait: then it is the twin that is slow
};

/// Whether samples arrive as fast as their source states, and whether its numbers or the clock of this machine
/// jump.  Frequencies, growth rates and times of alarms all stand on the stated rate.  theory.md (48.10)
class ArrivalWatch {
public:
  explicit ArrivalWatch(const ArrivalRule &rule = {});
  /// A source began.  @param rate  Hz, that it states
  void begin(double rate);

  struct News {
    enum class Kind { wrong_rate, right_again, played, jump } kind = Kind::jump;
    std::string text;
  };
  /// @param next     number behind the last sample that came
  /// @param n        samples that came with it
  /// @param waiting  s of samples that wait for the twin
  std::optional<News> arrived(std::int64_t next, std::int64_t n, const ClockReading &now, double waiting);
  /// Now and then: whether the clock of this machine was set.
  std::optional<News> look(const ClockReading &now);

  double rate() const;  ///< Hz, of the last window; NaN: none yet
  bool wrong() const;   ///< it was reported, and is not over

private:
  std::optional<News> judge(double seconds, double unsure);
  std::optional<News> jumped(std::int64_t next, std::int64_t n, double now);

  ArrivalRule rule_;
  double stated_     = 0;
  std::int64_t from_ = 0, last_ = 0, longest_ = 0;  // numbers; samples of the longest block
  double begin_ = 0, last_at_ = 0;                  // s, steady
  bool begun_ = false, has_last_ = false;
  int off_ = 0, right_ = 0;  // windows in a row; the sign of off_ says which way
  bool wrong_ = false, told_played_ = false;
  double measured_ = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> offset_;  // s, of the two clocks
};
}  // namespace mill::live
