#include "twin/records/channel_names.h"
#include "core/base/si_unit.h"
#include "core/base/valid_text.h"
#include "twin/records/channel_scale.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double largest_value = 1e15;  // in the file's unit: no measured value of a mill reaches it

bool is_one_of(const std::string &word, const std::initializer_list<const char *> list)
{
  return std::any_of(list.begin(), list.end(), [&](const char *one) { return word == one; });
}

std::string plural(const Eigen::Index n, const char *one, const char *many)
{
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

bool holds(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

// time_ms is the time, with its unit behind the name.
std::string without_unit(const std::string &name)
{
  const auto position = name.rfind('_');
  return position != std::string::npos && seconds_per(name.substr(position + 1)) > 0 ? name.substr(0, position)
                                                                                     : name;
}

// Infinite values and those that no instrument measures become missing ones.
Eigen::Index remove_impossible(Eigen::VectorXd &values)
{
  Eigen::Index n = 0;
  for (double &value : values)
    if (!(std::abs(value) <= largest_value)) {
      n += !std::isnan(value);
      value = std::numeric_limits<double>::quiet_NaN();
    }
  return n;
}
}  // namespace

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

ColumnHead head_of(const std::string_view text)
{
  const std::string all = trimmed_cell(valid_text(text));
  for (const auto &[open, close] : {std::pair('[', ']'), std::pair('(', ')')})
    if (const auto position = all.rfind(open);
        position != std::string::npos && !all.empty() && all.back() == close)
      return {trimmed_cell(std::string_view(all).substr(0, position)),
              trimmed_cell(std::string_view(all).substr(position + 1, all.size() - position - 2))};
  for (const std::string_view word : {" in ", " / "})
    if (const auto position = all.rfind(word); position != std::string::npos) {
      const std::string unit = trimmed_cell(std::string_view(all).substr(position + word.size()));
      if (unit_of_column(unit, "").known || seconds_per(unit) > 0)
        return {trimmed_cell(std::string_view(all).substr(0, position)), unit};
    }
  if (const auto position = all.rfind('_'); position != std::string::npos) {  // timestamp_ms, but not chock_ms
    const std::string unit = all.substr(position + 1);
    if (seconds_per(unit) > 0 && time_name(all.substr(0, position)) == TimeName::strong)
      return {all, unit};
  }
  return {all, ""};
}

TimeName time_name(const std::string &name)
{
  const std::string small = without_unit(lower(trimmed_cell(name)));
  if (is_one_of(small, {"x", "x-axis", "x axis", "x_value", "x-value", "x value"}))
    return TimeName::weak;
  const bool strong = is_one_of(
      small, {"time",     "zeit",      "t",         "timestamp",    "time stamp",    "time_stamp", "zeitstempel",
              "datetime", "date/time", "date time", "datum/zeit",   "datum uhrzeit", "temps",      "tiempo",
              "tempo",    "uhrzeit",   "zeitpunkt", "elapsed time", "elapsed",       "rel. time",  "relative time",
              "unixtime", "unix time", "unix_time", "epoch",        "posix time"});
  return strong ? TimeName::strong : TimeName::none;
}

int time_column_among(const std::vector<TimeEvidence> &columns)
{
  int best = -1, most = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TimeEvidence &c = columns[i];
    const bool in_seconds = seconds_per(c.unit) > 0, other_unit = !c.unit.empty() && !in_seconds;
    const TimeName named = time_name(c.name);
    const bool by_name   = named == TimeName::strong || (named == TimeName::weak && (in_seconds || !other_unit));
    const bool by_unit   = in_seconds && (c.is_increasing || named != TimeName::none);
    if ((other_unit && !c.is_text) || !(by_name || by_unit || c.is_text) ||
        (named == TimeName::weak && !in_seconds && !c.is_increasing))
      continue;
    const int score = 4 * in_seconds + 3 * (named == TimeName::strong) + (named == TimeName::weak) +
                      5 * (c.is_increasing || c.is_text);
    if (score > most) {
      most = score;
      best = int(i);
    }
  }
  return best;
}

void add_channel(RawRecord &record, const ColumnHead &head, const Place &place, const ReadOptions &options,
                 Eigen::VectorXd numbers)
{
  RawChannel channel;
  channel.column    = valid_text(head.name);
  const auto mapped = options.channels.find(channel.column);
  channel.name      = mapped != options.channels.end() ? mapped->second : channel.column;
  const auto given  = options.units.find(channel.column);
  ColumnUnit unit =
      unit_of_column(given != options.units.end() ? given->second : valid_text(head.unit), channel.name);
  if (const auto scale = scale_of(channel.column, unit, options))
    unit = *scale;
  channel.unit       = unit.si;
  channel.quantity   = unit.quantity;
  channel.unit_known = unit.known;
  channel.place      = place;
  if (const Eigen::Index n = remove_impossible(numbers); n > 0)
    record.notes.push_back(fmt::format("{}: {} infinite or beyond 1e15 and taken as missing", channel.name,
                                       plural(n, "value is", "values are")));
  channel.value = std::move(numbers);
  if (unit.factor != 1)
    channel.value *= unit.factor;
  if (!unit.known && !is_in(unit.si, SiUnit::one))
    record.notes.push_back(fmt::format("{}: unit '{}' not converted", channel.name, unit.si));
  record.channels.push_back(std::move(channel));
}

std::string shell_word(const std::string &text)
{
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](const char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-+=./:%@,").find(c) != std::string_view::npos;
  });
  if (plain)
    return text;
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string command_with(const ReadOptions &options, const std::string &file, const std::string &more)
{
  const std::string typed =
      options.command.empty() ? "millstand analyse " + shell_word(valid_text(file)) : options.command;
  return typed + " " + more;
}

std::string by_option(const ReadOptions &options, const std::string &file, const std::string &text,
                      const std::string &more)
{
  return options.from_case ? "" : text + ": " + command_with(options, file, more);
}

std::string unit_options(const std::vector<std::string> &columns)
{
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(columns.size(), most); ++i)
    text += (text.empty() ? "--unit " : " --unit ") + shell_word(columns[i] + "=g");
  return text;
}

std::string listed(const std::vector<std::string> &names, const std::size_t most)
{
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    text += (i == 0 ? "'" : ", '") + names[i] + "'";
  return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
}

namespace {
// "write the unit behind the name, .., or", where no option follows.
std::string without_option(const std::string &remedy, const std::string &format)
{
  return format == "CSV" ? remedy.substr(0, remedy.rfind(',')) : "export the record as CSV with units";
}
}  // namespace

void require_usable_channels(RawRecord &record, const ReadOptions &options, const std::string &remedy)
{
  std::vector<Problem> problems;
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < record.channels.size(); ++i) {
    const RawChannel &one = record.channels[i];
    columns.push_back(one.column);
    if (std::any_of(record.channels.begin(), record.channels.begin() + std::ptrdiff_t(i),
                    [&](const RawChannel &other) { return other.name == one.name; }))
      problems.push_back(
          {one.place,
           fmt::format("the channel '{}' appears twice in this record; rename one of the two columns", one.name),
           {}});
  }
  if (!problems.empty())
    throw InputError(problems);
  const Place head = record.channels.empty() ? Place{record.file, 1, 1} : record.channels.front().place;
  for (const std::string &asked : options.asked)
    if (!holds(columns, asked) && !holds(record.other_columns, asked)) {
      const std::string message =
          fmt::format("there is no column '{}' in this record; its columns are {}", asked, listed(columns));
      if (!options.several)
        throw InputError(head, message);
      record.notes.push_back(message);
    }
  if (std::none_of(record.channels.begin(), record.channels.end(),
                   [](const RawChannel &c) { return c.unit_known; }))
    throw InputError(
        head, fmt::format("no column of this record has a known unit; its columns are {}; {}", listed(columns),
                          options.from_case
                              ? without_option(remedy, record.format)
                              : remedy + ": " + command_with(options, record.file, unit_options(columns))));
}
}  // namespace mill::twin
