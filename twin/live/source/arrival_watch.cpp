#include "twin/live/source/arrival_watch.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::live {
ArrivalWatch::ArrivalWatch(const ArrivalRule &rule) : rule_(rule) {}

void ArrivalWatch::begin(const double rate)
{
  const auto offset = offset_;
  *this             = ArrivalWatch(rule_);
  stated_           = rate;
  offset_           = offset;
}

double ArrivalWatch::rate() const
{
  return measured_;
}

bool ArrivalWatch::wrong() const
{
  return wrong_;
}

// Numbers that run ahead of the time that has passed: no sample comes before it was measured.
std::optional<ArrivalWatch::News> ArrivalWatch::jumped(const std::int64_t next, const std::int64_t n,
                                                       const double now)
{
  const bool had     = std::exchange(has_last_, true);
  const double ahead = double(next - last_) / stated_ - (now - last_at_);
  last_              = next;
  last_at_           = now;
  if (!had || !(ahead - double(n) / stated_ > rule_.jump) ||
      !(measured_ < rule_.played * stated_))  // of a played record gaps do so
    return {};
  begun_ = false;
  return News{
      News::Kind::jump,
      fmt::format("the numbers of the samples jump ahead by {:.1f} s more than has passed: the clock of the "
                  "source was set forward, or its counter slipped; what lies between is missing. Let "
                  "the source count its samples and not its clock",
                  ahead)};
}

// (48.10): over the window, in units of the stated rate; what a block more or less at its ends makes is allowed.
std::optional<ArrivalWatch::News> ArrivalWatch::judge(const double seconds, const double unsure)
{
  const double off = measured_ / stated_ - 1;
  if (measured_ > rule_.played * stated_) {
    off_ = right_ = 0;
    if (std::exchange(told_played_, true))
      return {};
    return News{
        News::Kind::played,
        fmt::format("samples arrive {:.3g} times as fast as the {:g} Hz of their source: taken for a record "
                    "that is played, or for one that catches up",
                    measured_ / stated_, stated_)};
  }
  const int way = std::abs(off) <= rule_.tolerance + unsure ? 0 : off > 0 ? 1 : -1;
  right_        = way == 0 ? right_ + 1 : 0;
  off_          = way == 0 ? 0 : off_ * way >= 0 ? off_ + way : way;
  if (wrong_ && right_ >= rule_.in_a_row) {
    wrong_ = false;
    return News{News::Kind::right_again,
                fmt::format("samples arrive at {:.6g} Hz again, as their source states", measured_)};
  }
  if (wrong_ || std::abs(off_) < rule_.in_a_row)
    return {};
  wrong_ = true;
  return News{
      News::Kind::wrong_rate,
      fmt::format(
          "samples arrive at {:.6g} Hz by the clock of this machine, {} times in a row over {:.0f} s, where their "
          "source states {:g} Hz: {:.1f} % {}. Every frequency and growth rate is wrong by as much; correct "
          "the rate (\"rate\" of the head, --rate for a file without times), or the clock of the source",
          measured_, rule_.in_a_row, seconds, stated_, 100 * std::abs(off), off > 0 ? "more" : "less")};
}

std::optional<ArrivalWatch::News> ArrivalWatch::arrived(const std::int64_t next, const std::int64_t n,
                                                        const ClockReading &now, const double waiting)
{
  if (auto jump = jumped(next, n, now.steady))
    return jump;
  longest_ = std::max(longest_, n);
  if (!begun_ || waiting > rule_.behind) {
    begun_ = true;
    from_  = next;
    begin_ = now.steady;
    return {};
  }
  const double seconds = now.steady - begin_,
               unsure  = double(longest_) / double(std::max<std::int64_t>(1, next - from_));
  if (seconds < rule_.window || unsure > 0.5 * rule_.tolerance)
    return {};
  measured_ = double(next - from_) / seconds;
  from_     = next;
  begin_    = now.steady;
  return judge(seconds, unsure);
}

std::optional<ArrivalWatch::News> ArrivalWatch::look(const ClockReading &now)
{
  const double offset = now.utc - now.steady, set = offset - offset_.value_or(offset);
  offset_ = offset;
  if (!(std::abs(set) > rule_.jump))
    return {};
  return News{News::Kind::jump,
              fmt::format("the clock of this machine was set {} by {:.1f} s: times of alarms and of a source that "
                          "does not say when it began follow it, numbers of samples do not",
                          set > 0 ? "forward" : "back", std::abs(set))};
}
}  // namespace mill::live
