#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mill::twin {
/// Rules of a time zone as the system stores them (TZif).  Source: RFC 8536.
class TimeZone {
public:
  /// @param folder  of the zones, "/usr/share/zoneinfo" on Debian
  /// @throws InputError  no zone of this name, or a file that is none
  TimeZone(const std::string &name, const std::string &folder);

  /// All UTC times (s since 1970) at which clocks of the zone show this local time: none in the hour that is
  /// skipped in spring, two in the hour that comes twice in autumn.
  /// @throws InputError  beyond the last change that the system knows of a zone that goes on changing
  std::vector<std::int64_t> utc_of(std::int64_t local_seconds) const;
  const std::string &name() const;

private:
  std::string name_;
  std::vector<std::int64_t> change_;  // UTC s
  std::vector<std::int32_t> offset_;  // s east of UTC; [0] before the first change, one more than changes
  bool goes_on_ = false;              // changes follow a rule beyond the table
};

/// A point in time as a text: date and time of day, with or without an offset from UTC.
struct TimeText {
  std::int64_t local_seconds;          ///< s since 1970 as the text shows them
  std::int64_t nanoseconds;            ///< 0 .. 999 999 999
  std::optional<std::int32_t> offset;  ///< s east of UTC; none: a local time
  bool dated;                          ///< false: a time of day alone
};

/// "2026-01-05T10:00:00.00005+01:00", also with a blank or "/", "05.01.2026 10:00:00,0005", "1/5/2026 10:00:00 AM"
/// (AM and PM: the month comes first), "10:00:00.5" alone (of 1970-01-01).  Nothing where the text is not one of
/// these; a date such as 01/05/2026 without AM or PM has two readings and is not one, 13/05/2026 has one.
std::optional<TimeText> time_of_text(std::string_view text);

/// Is it a time that is not understood only because its day and its month can be exchanged?
bool has_two_readings(std::string_view text);
}  // namespace mill::twin
