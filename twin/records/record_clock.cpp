#include "twin/records/record_clock.h"
#include <fmt/format.h>

namespace mill::twin {
RecordClock::RecordClock(const ReadOptions &options) : from_case(options.from_case)
{
  if (!options.zone.empty())
    zone.emplace(options.zone, options.zone_folder);
}

double RecordClock::relative(const double seconds)
{
  if (!zero)
    zero = seconds;
  return seconds - *zero;
}

double RecordClock::seconds_of(const std::string_view text, const Place &place)
{
  const auto time = time_of_text(text);
  if (!time)
    throw InputError(place, fmt::format("'{}' {}; write for example 2026-01-05T10:00:00.00005+01:00", text,
                                        has_two_readings(text) ? "has two readings, by the order of day and month"
                                                               : "is not a time"));
  has_date               = time->dated;
  const std::int64_t utc = utc_of(*time, text, place);
  if (!first) {
    first             = utc;
    first_nanoseconds = time->nanoseconds;
  }
  return double(utc - *first) + 1e-9 * double(time->nanoseconds - first_nanoseconds);
}

std::int64_t RecordClock::utc_of(const TimeText &time, const std::string_view text, const Place &place)
{
  if (time.offset)
    return time.local_seconds - *time.offset;
  if (!time.dated)
    return time.local_seconds;
  if (!zone)
    throw InputError(place, fmt::format("the time '{}' has no offset from UTC; write it with one, for example "
                                        "2026-01-05T10:00:00+01:00{}",
                                        text, from_case ? "" : ", or name its zone with --zone Europe/Berlin"));
  constexpr std::int64_t quarter_hour = 900;  // clocks change at no other times
  if (time.local_seconds / quarter_hour == quarter)
    return time.local_seconds - offset;
  const auto utc = zone->utc_of(time.local_seconds);
  if (utc.empty())
    throw InputError(place,
                     fmt::format("the clocks of {} skip the time '{}' (summer time begins); write the times "
                                 "with their offset from UTC",
                                 zone->name(), text));
  if (utc.size() > 1)
    throw InputError(place, fmt::format("the clocks of {} show the time '{}' twice (summer time ends); write the "
                                        "times with their offset from UTC",
                                        zone->name(), text));
  quarter = time.local_seconds / quarter_hour;
  offset  = time.local_seconds - utc.front();
  return utc.front();
}

std::optional<double> RecordClock::start() const
{
  if (!first || !has_date)
    return {};
  return double(*first) + 1e-9 * double(first_nanoseconds);
}
}  // namespace mill::twin
