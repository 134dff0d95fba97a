#include "twin/records/csv_layout.h"
#include "twin/records/record_clock.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr std::size_t lines_looked_at = 60;

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

class CsvReader {
public:
  CsvReader(const std::string &path, const ReadOptions &read_options)
      : source(path), options(read_options), clock(read_options)
  {
    record.file   = path;
    record.format = "CSV";
  }
  RawRecord read()
  {
    look_at_head();
    for (std::size_t i = next_of_head; i < head_lines.size(); ++i)
      take(head_lines[i], int(i) + 1, i + 1 == head_lines.size() && source.ended_without_newline());
    std::string_view line;
    while (source.next(line))
      take(line, source.number(), source.ended_without_newline());
    finish();
    return std::move(record);
  }

private:
  void look_at_head()
  {
    std::string_view line;
    while (head_lines.size() < lines_looked_at && source.next(line))
      head_lines.emplace_back(line);
    layout       = layout_of(record.file, head_lines);
    record.notes = layout.notes;
    next_of_head = std::size_t(layout.first_data_line - 1);
    times        = time_columns_of(layout);
    for (std::size_t i = 0; i < layout.columns.size(); ++i) {
      const bool timed = int(i) == times.time || int(i) == times.date;
      const bool named = !layout.columns[i].head.name.empty();
      channel_of_column.push_back(timed || !named ? -1 : int(column_of_channel.size()));
      if (!timed && named)
        column_of_channel.push_back(i);
    }
    values.resize(column_of_channel.size());
    const double per_line = double(head_lines[next_of_head].size()) + 1;
    const auto expected   = std::size_t(1.05 * source.size() / per_line) + 16;
    for (auto &column : values)
      column.reserve(expected);
    if (times.time >= 0)
      seconds.reserve(expected);
    prepare_clock();
  }

  void prepare_clock()
  {
    if (times.time < 0) {
      if (!options.rate)
        throw InputError(layout.columns.front().place,
                         "no column holds the time; name one, for example \"time [s]\", or give the samples per "
                         "second with --rate 20000");
      record.rate = *options.rate;
      return;
    }
    record.time_place = layout.columns[std::size_t(times.time)].place;
    split_cells(head_lines[next_of_head], layout.separator, unquoted, cells);
    double number = 0;
    const auto at = std::size_t(times.time);
    texts         = at < cells.size() && !number_of_cell(cells[at], layout.separator, number, had_comma);
    if (!texts && times.seconds == 0 && !options.rate) {
      const std::string name = layout.columns[at].head.name, unit = layout.columns[at].head.unit;
      throw InputError(record.time_place,
                       unit.empty()
                           ? fmt::format("column '{}' has no unit; write for example \"{} [s]\", or give "
                                         "the samples per second with --rate 20000",
                                         name, name)
                           : fmt::format("column '{}' has the unit '{}'; a time in s, ms, us, min or h is "
                                         "needed, or the samples per second with --rate 20000",
                                         name, unit));
    }
    if (options.rate) {
      record.rate = *options.rate;
      record.notes.push_back(
          fmt::format("the column '{}' was not used: the rate was given", layout.columns[at].head.name));
      times.time = -1;
      seconds.clear();
      seconds.shrink_to_fit();
    }
  }

  void take(const std::string_view line, const int number, const bool last)
  {
    if (line.empty() || line.find_first_not_of(" \t") == std::string_view::npos) {
      ++n_blank;
      return;
    }
    if (line.front() == '#')
      return;
    cut(line);
    const std::size_t n = layout.columns.size();
    while (cells.size() > n && cells.back().empty())
      cells.pop_back();
    if (cells.size() < n && last) {
      record.notes.push_back(fmt::format("line {}, the last, is cut off and was not used", number));
      return;
    }
    if (cells.size() != n)
      throw InputError(Place{record.file, number, 1},
                       fmt::format("this line has {} cells, the columns are {}; a decimal comma needs ';' or tab "
                                   "between the columns",
                                   cells.size(), n));
    if (times.time >= 0)
      take_time(line, number);
    for (std::size_t c = 0; c < n; ++c)
      if (const int channel = channel_of_column[c]; channel >= 0)
        values[std::size_t(channel)].push_back(value_of(line, c, number));
  }

  void cut(const std::string_view line)
  {
    if (line.find('"') != std::string_view::npos) {
      split_cells(line, layout.separator, unquoted, cells);
      return;
    }
    cells.clear();
    std::size_t at = 0;
    while (true) {
      const auto end   = std::min(line.find(layout.separator, at), line.size());
      std::size_t from = at, to = end;
      while (from < to && (line[from] == ' ' || line[from] == '\t'))
        ++from;
      while (to > from && (line[to - 1] == ' ' || line[to - 1] == '\t' || line[to - 1] == '\r'))
        --to;
      cells.push_back(line.substr(from, to - from));
      if (end == line.size())
        return;
      at = end + 1;
    }
  }

  Place place(const std::string_view line, const std::size_t c, const int number) const
  {
    return {record.file, number, column_of(line, cells[c], c, layout.separator)};
  }

  double value_of(const std::string_view line, const std::size_t c, const int number)
  {
    double value = 0;
    if (number_of_cell(cells[c], layout.separator, value, had_comma))
      return value;
    if (is_missing(cells[c]))
      return std::numeric_limits<double>::quiet_NaN();
    throw InputError(place(line, c, number),
                     fmt::format("'{}' in column '{}' is no number; leave the cell empty where there is no value",
                                 cells[c], layout.columns[c].head.name));
  }

  void take_time(const std::string_view line, const int number)
  {
    const auto c  = std::size_t(times.time);
    double second = 0;
    if (texts) {
      const Place at = place(line, c, number);
      second =
          times.date < 0
              ? clock.seconds_of(cells[c], at)
              : clock.seconds_of(std::string(cells[std::size_t(times.date)]) + " " + std::string(cells[c]), at);
    } else if (double value = 0; number_of_cell(cells[c], layout.separator, value, had_comma)) {
      second = clock.relative(value * times.seconds);
    } else
      throw InputError(place(line, c, number), fmt::format("'{}' in the time column '{}' is no time", cells[c],
                                                           layout.columns[c].head.name));
    if (!seconds.empty() && second < seconds.back())
      throw InputError(
          place(line, c, number),
          fmt::format("the time goes backwards here, by {:.4g} s; sort the lines by time, or split the "
                      "file where the recorder started again",
                      seconds.back() - second));
    seconds.push_back(second);
  }

  void finish()
  {
    if (source.encoding() != "UTF-8")
      record.notes.push_back("the file is " + source.encoding());
    if (had_comma)
      record.notes.push_back("decimal commas were read as decimal points");
    if (n_blank > 0)
      record.notes.push_back(fmt::format("{} blank line{} skipped", n_blank, n_blank == 1 ? " was" : "s were"));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto &column = layout.columns[column_of_channel[i]];
      Eigen::VectorXd numbers =
          Eigen::Map<const Eigen::VectorXd>(values[i].data(), Eigen::Index(values[i].size()));
      std::vector<double>().swap(values[i]);
      record.channels.push_back(channel_of(column.head, column.place, options, std::move(numbers)));
    }
    if (times.time >= 0)
      record.time = Eigen::Map<const Eigen::VectorXd>(seconds.data(), Eigen::Index(seconds.size()));
    record.start = clock.start();
    require_usable_channels(record, "write the unit behind the name, for example \"upper_work_roll [g]\"");
  }

  LineSource source;
  const ReadOptions &options;
  RecordClock clock;
  RawRecord record;
  CsvLayout layout;
  TimeColumns times;
  std::vector<std::string> head_lines;
  std::size_t next_of_head = 0;
  std::vector<int> channel_of_column;  // -1: none
  std::vector<std::size_t> column_of_channel;
  std::vector<std::vector<double>> values;
  std::vector<double> seconds;
  std::deque<std::string> unquoted;
  std::vector<std::string_view> cells;
  bool texts = false, had_comma = false;
  int n_blank = 0;
};
}  // namespace

RawRecord read_csv_record(const std::string &path, const ReadOptions &options)
{
  return CsvReader(path, options).read();
}
}  // namespace mill::twin
