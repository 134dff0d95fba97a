#include "twin/records/time_zone.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <optional>

namespace mill::twin {
namespace {
constexpr std::size_t header_size = 44;

std::int64_t big_endian(const std::string &bytes, const std::size_t position, const int n)
{
  std::uint64_t value = 0;
  for (int i = 0; i < n; ++i)
    value = value << 8 | std::uint8_t(bytes[position + std::size_t(i)]);
  return n == 4 ? std::int64_t(std::int32_t(std::uint32_t(value))) : std::int64_t(value);
}

struct Counts {
  std::size_t utc_flags, standard_flags, leaps, changes, types, characters;
};

// Counts of the header at a position, where the file has one there.  Nothing where one of them is larger than the
// file: what follows cannot fit, and no length made of them can wrap.
std::optional<Counts> counts_at(const std::string &bytes, const std::size_t position)
{
  if (bytes.size() < header_size || position > bytes.size() - header_size)
    return {};
  std::array<std::size_t, 6> count{};
  for (std::size_t i = 0; i < count.size(); ++i) {
    count[i] = std::uint32_t(big_endian(bytes, position + 20 + 4 * i, 4));
    if (count[i] > bytes.size())
      return {};
  }
  return Counts{count[0], count[1], count[2], count[3], count[4], count[5]};
}

// Length of what follows a header.
std::size_t length_of(const Counts &c, const std::size_t time_size)
{
  return c.changes * (time_size + 1) + c.types * 6 + c.characters + c.leaps * (time_size + 4) + c.standard_flags +
         c.utc_flags;
}

bool is_plain_name(const std::string &name)
{
  return !name.empty() && name.front() != '/' && name.find("..") == std::string::npos &&
         std::all_of(name.begin(), name.end(), [](const char c) {
           return std::isalnum(static_cast<unsigned char>(c)) || c == '/' || c == '_' || c == '-' || c == '+';
         });
}

// Days since 1970-01-01 of the Gregorian calendar.  Source: H. Hinnant, chrono-compatible low-level date
// algorithms.
std::int64_t days_of(std::int64_t year, const int month, const int day)
{
  year -= month <= 2;
  const std::int64_t era = (year >= 0 ? year : year - 399) / 400, of_era = year - era * 400;
  const std::int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

// Reads a text from the left, digit group by digit group.
class TextReader {
public:
  explicit TextReader(const std::string_view text) : rest(text) {}
  bool number(const std::size_t least, const std::size_t most, int &value)
  {
    std::size_t n = 0;
    value         = 0;
    while (n < most && n < rest.size() && rest[n] >= '0' && rest[n] <= '9')
      value = 10 * value + (rest[n++] - '0');
    rest.remove_prefix(n);
    return n >= least;
  }
  bool one_of(const std::string_view set, char &letter)
  {
    if (rest.empty() || set.find(rest.front()) == std::string_view::npos)
      return false;
    letter = rest.front();
    rest.remove_prefix(1);
    return true;
  }
  bool one_of(const std::string_view set)
  {
    char ignored;
    return one_of(set, ignored);
  }
  std::int64_t fraction()
  {
    std::int64_t value = 0;
    int n              = 0;
    for (; !rest.empty() && rest.front() >= '0' && rest.front() <= '9'; rest.remove_prefix(1))
      if (n < 9) {
        value = 10 * value + (rest.front() - '0');
        ++n;
      }
    for (; n < 9; ++n)
      value *= 10;
    return value;
  }
  bool done() const
  {
    return rest.empty();
  }
  std::string_view left() const
  {
    return rest;
  }

private:
  std::string_view rest;
};

bool is_date(const int year, const int month, const int day)
{
  static const int days[] = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap         = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1] && (month != 2 || day < 29 || leap);
}

// Date in front of a time of day, as written.
struct DateText {
  int first = 0, second = 0, third = 0;
  char mark = 0;
};

// Days since 1970 of a date; nothing where it is not one, or has two readings.
// @param american  the text ends with AM or PM: the month comes first
std::optional<std::int64_t> days_of_date(const DateText &date, const bool american)
{
  if (date.first >= 1000)  // 2026-01-05
    return is_date(date.first, date.second, date.third)
               ? std::optional(days_of(date.first, date.second, date.third))
               : std::nullopt;
  const int year = date.third;
  if (year < 1000)
    return {};
  const bool day_first   = is_date(year, date.second, date.first),
             month_first = is_date(year, date.first, date.second);
  const bool slash       = date.mark == '/';
  if (slash && !american && day_first && month_first && date.first != date.second)
    return {};  // 01/05/2026: 5 January or 1 May
  if (month_first && slash && (american || !day_first))
    return days_of(year, date.first, date.second);
  return day_first && !(slash && american) ? std::optional(days_of(year, date.second, date.first)) : std::nullopt;
}

bool read_date(TextReader &text, DateText &date)
{
  return text.number(1, 4, date.first) && text.one_of("-/.", date.mark) && text.number(1, 2, date.second) &&
         text.one_of({&date.mark, 1}) && text.number(1, 4, date.third);
}

// Cuts " AM" or "p.m." off the end of a text: 'a', 'p', or 0 where there is neither.
char cut_half_of_day(std::string_view &text)
{
  for (const auto &[ending, half] :
       {std::pair<std::string_view, char>("am", 'a'), {"pm", 'p'}, {"a.m.", 'a'}, {"p.m.", 'p'}}) {
    if (text.size() <= ending.size())
      continue;
    const auto tail = text.substr(text.size() - ending.size());
    if (!std::equal(tail.begin(), tail.end(), ending.begin(),
                    [](const char x, const char y) { return std::tolower(static_cast<unsigned char>(x)) == y; }))
      continue;
    text.remove_suffix(ending.size());
    while (!text.empty() && text.back() == ' ')
      text.remove_suffix(1);
    return half;
  }
  return 0;
}

// "Z", "+01:00", "+0100", "+01"; false where it is wrong.
bool read_offset(TextReader &text, std::optional<std::int32_t> &offset)
{
  char sign = 0;
  if (text.one_of("Zz")) {
    offset = 0;
    return text.done();
  }
  int hours = 0, minutes = 0;
  if (!text.one_of("+-", sign) || !text.number(2, 2, hours))
    return false;
  text.one_of(":");
  text.number(0, 2, minutes);
  offset = (sign == '-' ? -1 : 1) * (hours * 3600 + minutes * 60);
  return text.done() && hours < 24 && minutes < 60;
}
}  // namespace

TimeZone::TimeZone(const std::string &name, const std::string &folder) : name_(name)
{
  const std::string refusal = "there is no time zone '" + name + "'; name one such as Europe/Berlin or UTC";
  if (!is_plain_name(name))
    throw InputError(refusal);
  const auto read = text_if_readable(folder + "/" + name);
  if (!read || read->size() < header_size || read->compare(0, 4, "TZif") != 0 || (*read)[4] < '2')
    throw InputError(refusal);
  const std::string &bytes = *read;
  const auto first         = counts_at(bytes, 0);
  // The block with times of 64 bits.
  const std::size_t second = header_size + (first ? length_of(*first, 4) : 0);
  const auto counts        = first ? counts_at(bytes, second) : std::nullopt;
  if (!counts)
    throw InputError(refusal);
  const Counts c             = *counts;
  const std::size_t position = second + header_size;
  if (c.types == 0 || bytes.size() < position + length_of(c, 8))
    throw InputError(refusal);
  const auto offset_of_type = [&](const std::size_t type) {
    return std::int32_t(big_endian(bytes, position + c.changes * 9 + 6 * std::min(type, c.types - 1), 4));
  };
  offset_.push_back(offset_of_type(0));
  for (std::size_t i = 0; i < c.changes; ++i) {
    change_.push_back(big_endian(bytes, position + 8 * i, 8));
    offset_.push_back(offset_of_type(std::uint8_t(bytes[position + 8 * c.changes + i])));
  }
  goes_on_ = bytes.find(',', position + length_of(c, 8)) != std::string::npos;  // the rule as POSIX writes it
}

std::vector<std::int64_t> TimeZone::utc_of(const std::int64_t local_seconds) const
{
  constexpr std::int64_t year = 366 * 86400;
  if (goes_on_ && !change_.empty() && local_seconds - year > change_.back())
    throw InputError("this system knows the zone " + name_ +
                     " not as far as this time; write the times with their offset from UTC");
  std::vector<std::int64_t> times;
  for (std::size_t i = 0; i < offset_.size(); ++i) {
    const std::int64_t utc = local_seconds - offset_[i];
    const bool after       = i == 0 || utc >= change_[i - 1];
    const bool before      = i == change_.size() || utc < change_[i];
    if (after && before && std::find(times.begin(), times.end(), utc) == times.end())
      times.push_back(utc);
  }
  return times;
}

const std::string &TimeZone::name() const
{
  return name_;
}

std::optional<TimeText> time_of_text(std::string_view text)
{
  const char half = cut_half_of_day(text);
  TextReader reader(text);
  std::int64_t days = 0;
  const auto mark   = text.find_first_of("-/.");
  const bool dated  = text.substr(0, mark).find(':') == std::string_view::npos && mark != std::string_view::npos;
  if (dated) {
    DateText date;
    if (!read_date(reader, date) || !reader.one_of("T t_"))
      return {};
    while (reader.one_of(" ")) {
    }
    const auto parsed = days_of_date(date, half != 0);
    if (!parsed)
      return {};
    days = *parsed;
  }
  int hours = 0, minutes = 0, seconds = 0;
  if (!reader.number(1, 2, hours) || !reader.one_of(":") || !reader.number(2, 2, minutes))
    return {};
  std::int64_t nanoseconds = 0;
  if (reader.one_of(":")) {
    if (!reader.number(2, 2, seconds))
      return {};
    if (reader.one_of(".,:"))
      nanoseconds = reader.fraction();
  }
  if (half != 0) {
    if (hours < 1 || hours > 12)
      return {};
    hours = hours % 12 + (half == 'p' ? 12 : 0);
  }
  if (hours > 23 || minutes > 59 || seconds > 60)
    return {};
  TimeText time{days * 86400 + hours * 3600 + minutes * 60 + seconds, nanoseconds, {}, dated};
  if (!reader.done() && !read_offset(reader, time.offset))
    return {};
  return time;
}

bool has_two_readings(const std::string_view text)
{
  DateText date;
  TextReader reader(text);
  return !time_of_text(text) && read_date(reader, date) && date.mark == '/' && date.third >= 1000 &&
         is_date(date.third, date.first, date.second) && is_date(date.third, date.second, date.first);
}
}  // namespace mill::twin
