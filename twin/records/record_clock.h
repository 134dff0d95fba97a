#pragma once
#include "core/base/errors.h"
#include "twin/records/raw_record.h"
#include "twin/records/time_zone.h"
#include <optional>
#include <string_view>

namespace mill::twin {
/// Seconds from the first sample of a record, from whatever its time column holds.
class RecordClock {
public:
  explicit RecordClock(const ReadOptions &options);

  /// Of a number: the first call is time zero.
  double relative(double seconds);

  /// Of a text with date and time of day, or a time of day alone.
  /// @throws InputError at `place`  no time; a local time without a zone, one that the clocks skip or show twice
  double seconds_of(std::string_view text, const Place &place);

  /// s, the number of the first call of relative(); 0: there was none.
  double first_number() const
  {
    return zero.value_or(0);
  }

  /// s since 1970-01-01 UTC of the first sample; none: no date was read.
  std::optional<double> start() const;

private:
  std::int64_t utc_of(const TimeText &time, std::string_view text, const Place &place);

  bool from_case = false;
  std::optional<TimeZone> zone;
  std::optional<double> zero;         // of numbers
  std::optional<std::int64_t> first;  // s, of texts
  std::int64_t first_nanoseconds = 0;
  bool has_date                  = false;
  std::int64_t quarter = -1, offset = 0;  // of the last local time: quarter of an hour, local less UTC
};
}  // namespace mill::twin
