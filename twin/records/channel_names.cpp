#include "twin/records/channel_names.h"
#include "core/base/units.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
std::string trimmed(std::string_view text)
{
  const auto is_blank = [](const char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return std::string(text);
}

// Spellings of data loggers for units of the closed list.
std::string usual_spelling(const std::string &unit)
{
  static const std::array<std::pair<const char *, const char *>, 14> spellings{
      {{"m/s^2", "m/s2"},
       {"m/s\u00b2", "m/s2"},
       {"m/s**2", "m/s2"},
       {"M/S2", "m/s2"},
       {"G", "g"},
       {"gn", "g"},
       {"mm/sec", "mm/s"},
       {"m/sec", "m/s"},
       {"mpm", "m/min"},
       {"KN", "kN"},
       {"kn", "kN"},
       {"newton", "N"},
       {"Volt", "V"},
       {"volt", "V"}}
  };
  for (const auto &[from, to] : spellings)
    if (unit == from)
      return to;
  return unit;
}

bool is_speed_name(const std::string &name)
{
  return name == "speed" || name == "exit_speed" || name == "entry_speed" || name == "strip_speed";
}
}  // namespace

const char *name_of(const Quantity quantity)
{
  switch (quantity) {
  case Quantity::acceleration:
    return "acceleration";
  case Quantity::velocity:
    return "velocity";
  case Quantity::force:
    return "force";
  case Quantity::speed:
    return "speed";
  case Quantity::voltage:
    return "voltage";
  case Quantity::other:
    return "quantity without a known unit";
  }
  return "";
}

const RawChannel *RawRecord::find(const std::string &name) const
{
  for (const RawChannel &channel : channels)
    if (channel.name == name)
      return &channel;
  return nullptr;
}

Eigen::Index RawRecord::n_samples() const
{
  return channels.empty() ? time.size() : channels.front().value.size();
}

std::string lower(const std::string_view text)
{
  std::string result(text);
  for (char &c : result)
    c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return result;
}

ColumnHead head_of(const std::string_view text)
{
  const std::string all = trimmed(text);
  for (const auto &[open, close] : {std::pair('[', ']'), std::pair('(', ')')})
    if (const auto at = all.rfind(open); at != std::string::npos && !all.empty() && all.back() == close)
      return {trimmed(std::string_view(all).substr(0, at)),
              trimmed(std::string_view(all).substr(at + 1, all.size() - at - 2))};
  for (const char *word : {" in ", " / "})
    if (const auto at = all.rfind(word); at != std::string::npos) {
      const std::string unit = trimmed(std::string_view(all).substr(at + std::string_view(word).size()));
      if (unit_of_column(unit, "").known || seconds_per(unit) > 0)
        return {trimmed(std::string_view(all).substr(0, at)), unit};
    }
  return {all, ""};
}

ColumnUnit unit_of_column(const std::string &text, const std::string &name)
{
  const std::string spelling = usual_spelling(trimmed(text));
  for (const auto &[volt, factor] : {std::pair("V", 1.0), std::pair("mV", 1e-3)})
    if (spelling == volt)
      return {"V", factor, Quantity::voltage, true};
  if (spelling == "mm/s2" || spelling == "mm/s^2" || spelling == "mm/s\u00b2")
    return {"m/s2", 1e-3, Quantity::acceleration, true};
  const Unit *found = spelling.empty() ? nullptr : find_unit(spelling);
  if (!found)
    return {spelling.empty() ? "1" : spelling, 1, Quantity::other, false};
  const double factor = found->multiply / found->divide;
  if (found->dimension == unit("m/s2").dimension)
    return {"m/s2", factor, Quantity::acceleration, true};
  if (found->dimension == unit("N").dimension)
    return {"N", factor, Quantity::force, true};
  if (found->dimension == unit("m/s").dimension)
    return {"m/s", factor, is_speed_name(name) ? Quantity::speed : Quantity::velocity, true};
  return {found->symbol, 1, Quantity::other, true};
}

double seconds_per(const std::string &text)
{
  static const std::array<std::pair<const char *, double>, 18> units{
      {{"s", 1},
       {"sec", 1},
       {"second", 1},
       {"seconds", 1},
       {"sekunden", 1},
       {"ms", 1e-3},
       {"msec", 1e-3},
       {"us", 1e-6},
       {"\u00b5s", 1e-6},
       {"\u03bcs", 1e-6},
       {"usec", 1e-6},
       {"ns", 1e-9},
       {"min", 60},
       {"minuten", 60},
       {"minutes", 60},
       {"h", 3600},
       {"std", 3600},
       {"hours", 3600}}
  };
  const std::string spelling = lower(trimmed(text));
  for (const auto &[name, seconds] : units)
    if (spelling == name)
      return seconds;
  return 0;
}

bool is_time_name(const std::string &name)
{
  static const std::array<const char *, 16> names{
      "time",          "zeit",      "t",         "timestamp",  "zeitstempel", "x-axis",     "x",
      "datetime",      "date/time", "date time", "datum/zeit", "temps",       "time stamp", "uhrzeit",
      "datum uhrzeit", "zeitpunkt"};
  const std::string small = lower(trimmed(name));
  return std::find(names.begin(), names.end(), small) != names.end();
}

RawChannel channel_of(const ColumnHead &head, const Place &place, const ReadOptions &options,
                      Eigen::VectorXd numbers)
{
  RawChannel channel;
  channel.column         = head.name;
  const auto mapped      = options.channels.find(head.name);
  channel.name           = mapped != options.channels.end() ? mapped->second : head.name;
  const auto given       = options.units.find(head.name);
  const ColumnUnit found = unit_of_column(given != options.units.end() ? given->second : head.unit, channel.name);
  channel.unit           = found.si;
  channel.quantity       = found.quantity;
  channel.unit_known     = found.known;
  channel.place          = place;
  channel.value          = std::move(numbers);
  if (found.factor != 1)
    channel.value *= found.factor;
  for (double &value : channel.value)
    if (!std::isfinite(value))
      value = std::numeric_limits<double>::quiet_NaN();
  return channel;
}

void require_usable_channels(const RawRecord &record, const std::string &remedy)
{
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < record.channels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (record.channels[i].name == record.channels[j].name) {
        problems.push_back(
            {record.channels[i].place,
             fmt::format("the channel '{}' stands twice in this record; rename one of the two columns",
                         record.channels[i].name),
             {}});
        break;
      }
  if (!problems.empty())
    throw InputError(problems);
  const bool any = std::any_of(record.channels.begin(), record.channels.end(),
                               [](const RawChannel &c) { return c.unit_known; });
  if (!any)
    throw InputError(record.channels.empty() ? Place{record.file, 1, 1} : record.channels.front().place,
                     "no column of this record has a known unit; " + remedy);
}
}  // namespace mill::twin
