#include "twin/records/csv_rows.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
// Which columns tell the time, and how.
struct TimeColumns {
  int time = -1, date = -1;  // index of a column; date: of the day alone, beside a time of day
  double seconds = 0;        // per unit of a number; 0: texts
};

TimeColumns time_columns_of(const CsvLayout &layout)
{
  TimeColumns found;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const ColumnHead &head = layout.columns[i].head;
    const std::string name = lower(head.name);
    if (name == "date" || name == "datum")
      found.date = int(i);
    else if (found.time < 0 && is_time_name(head.name))
      found.time = int(i);
  }
  for (std::size_t i = 0; i < layout.columns.size() && found.time < 0; ++i)
    if (seconds_per(layout.columns[i].head.unit) > 0)
      found.time = int(i);
  if (found.time >= 0)
    found.seconds = seconds_per(layout.columns[std::size_t(found.time)].head.unit);
  else if (found.date >= 0)
    std::swap(found.time, found.date);  // "Date" holds day and time of day
  return found;
}

}  // namespace

CsvRows::CsvRows(std::string file, const std::vector<std::string> &head, const ReadOptions &options)
    : file_(std::move(file)), options_(options), clock_(options), layout_(layout_of(file_, head)),
      notes_(layout_.notes)
{
  const TimeColumns times = time_columns_of(layout_);
  time_                   = times.time;
  date_                   = times.date;
  per_unit_               = times.seconds;
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    const bool timed_column = int(i) == time_ || int(i) == date_;
    const bool named        = !layout_.columns[i].head.name.empty();
    channel_of_column_.push_back(timed_column || !named ? -1 : int(columns_.size()));
    if (!timed_column && named)
      columns_.push_back(i);
  }
  values_.resize(columns_.size());
  prepare_clock(head);
}

Place CsvRows::time_place(const std::string_view line, const int number) const
{
  return place(line, std::size_t(time_), number);
}

void CsvRows::prepare_clock(const std::vector<std::string> &head)
{
  if (time_ < 0) {
    if (!options_.rate)
      throw InputError(layout_.columns.front().place,
                       "no column holds the time; name one, for example \"time [s]\", or give the samples per "
                       "second with --rate 20000");
    return;
  }
  time_column_ = layout_.columns[std::size_t(time_)].place;
  split_cells(head[std::size_t(layout_.first_data_line - 1)], layout_.separator, unquoted_, cells_);
  double number = 0;
  const auto at = std::size_t(time_);
  texts_        = at < cells_.size() && !number_of_cell(cells_[at], layout_.separator, number, had_comma_);
  if (!texts_ && per_unit_ == 0 && !options_.rate) {
    const std::string name = layout_.columns[at].head.name, unit = layout_.columns[at].head.unit;
    throw InputError(time_column_,
                     unit.empty() ? fmt::format("column '{}' has no unit; write for example \"{} [s]\", or give "
                                                "the samples per second with --rate 20000",
                                                name, name)
                                  : fmt::format("column '{}' has the unit '{}'; a time in s, ms, us, min or h is "
                                                "needed, or the samples per second with --rate 20000",
                                                name, unit));
  }
  if (options_.rate) {
    notes_.push_back(
        fmt::format("the column '{}' was not used: the rate was given", layout_.columns[at].head.name));
    time_ = -1;
  }
}

CsvRows::Kind CsvRows::take(const std::string_view line, const int number, const bool last)
{
  if (line.empty() || line.find_first_not_of(" \t") == std::string_view::npos) {
    ++blank_lines_;
    return Kind::nothing;
  }
  if (line.front() == '#')
    return Kind::nothing;
  cut(line);
  const std::size_t n = layout_.columns.size();
  while (cells_.size() > n && cells_.back().empty())
    cells_.pop_back();
  if (cells_.size() < n && last) {
    notes_.push_back(fmt::format("line {}, the last, is cut off and was not used", number));
    return Kind::cut_off;
  }
  if (cells_.size() != n)
    throw InputError(Place{file_, number, 1},
                     fmt::format("this line has {} cells, the columns are {}; a decimal comma needs ';' or tab "
                                 "between the columns",
                                 cells_.size(), n));
  if (time_ >= 0)
    take_time(line, number);
  for (std::size_t c = 0; c < n; ++c)
    if (const int channel = channel_of_column_[c]; channel >= 0)
      values_[std::size_t(channel)] = value_of(line, c, number);
  return Kind::samples;
}

void CsvRows::cut(const std::string_view line)
{
  if (line.find('"') != std::string_view::npos) {
    split_cells(line, layout_.separator, unquoted_, cells_);
    return;
  }
  cells_.clear();
  std::size_t at = 0;
  while (true) {
    const auto end   = std::min(line.find(layout_.separator, at), line.size());
    std::size_t from = at, to = end;
    while (from < to && (line[from] == ' ' || line[from] == '\t'))
      ++from;
    while (to > from && (line[to - 1] == ' ' || line[to - 1] == '\t' || line[to - 1] == '\r'))
      --to;
    cells_.push_back(line.substr(from, to - from));
    if (end == line.size())
      return;
    at = end + 1;
  }
}

Place CsvRows::place(const std::string_view line, const std::size_t c, const int number) const
{
  return {file_, number, column_of(line, cells_[c], c, layout_.separator)};
}

double CsvRows::value_of(const std::string_view line, const std::size_t c, const int number)
{
  double value = 0;
  if (number_of_cell(cells_[c], layout_.separator, value, had_comma_))
    return value;
  if (is_missing(cells_[c]))
    return std::numeric_limits<double>::quiet_NaN();
  throw InputError(place(line, c, number),
                   fmt::format("'{}' in column '{}' is no number; leave the cell empty where there is no value",
                               cells_[c], layout_.columns[c].head.name));
}

void CsvRows::take_time(const std::string_view line, const int number)
{
  const auto c  = std::size_t(time_);
  double second = 0;
  if (texts_) {
    const Place at = place(line, c, number);
    second         = date_ < 0
                         ? clock_.seconds_of(cells_[c], at)
                         : clock_.seconds_of(std::string(cells_[std::size_t(date_)]) + " " + std::string(cells_[c]), at);
  } else if (double value = 0; number_of_cell(cells_[c], layout_.separator, value, had_comma_)) {
    second = clock_.relative(value * per_unit_);
  } else
    throw InputError(place(line, c, number), fmt::format("'{}' in the time column '{}' is no time", cells_[c],
                                                         layout_.columns[c].head.name));
  seconds_ = second;
}

}  // namespace mill::twin
