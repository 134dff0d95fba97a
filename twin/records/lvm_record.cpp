#include "core/base/choice.h"
#include "core/base/text.h"
#include "twin/records/channel_names.h"
#include "twin/records/line_source.h"
#include "twin/records/number_style.h"
#include "twin/records/record_clock.h"
#include "twin/records/sampling_rate.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// LabVIEW measurement files: a head of keys, then runs of samples, each below keys of its channels.
// Source: National Instruments, Specification for the LabVIEW Measurement File (.lvm), 2009.
namespace mill::twin {
namespace {
// Columns of X_Value: none, one of all channels, one of each.
enum class XColumns { no, one, multi };
constexpr auto words_of(XColumns)
{
  return choice_words<XColumns>("No", "One", "Multi");
}
// Keys of the head of the file that are read.
enum class HeadKey { decimal_separator, x_columns, date, time };
constexpr auto words_of(HeadKey)
{
  return choice_words<HeadKey>("Decimal_Separator", "X_Columns", "Date", "Time");
}

constexpr const char *apart    = "; export each run as a file of its own";
constexpr const char *no_times = ", and no column says the times";

class LvmReader {
public:
  LvmReader(const std::string &path, const ReadOptions &read_options) : source(path), options(read_options)
  {
    record.file   = path;
    record.format = "LabVIEW";
  }

  RawRecord read()
  {
    std::string_view line;
    if (!source.next(line) || trimmed_cell(line).rfind("LabVIEW Measurement", 0) != 0)
      throw InputError(place(),
                       "this is not a LabVIEW measurement file: its first line is not \"LabVIEW Measurement\"");
    read_file_head();
    while (source.next(line))
      take(line);
    finish();
    return std::move(record);
  }

private:
  Place place() const
  {
    return {record.file, source.number(), 1};
  }

  std::vector<std::string> cells_of(const std::string_view line) const
  {
    std::vector<std::string> cells;
    for (std::size_t position = 0; position <= line.size();) {
      const auto end = std::min(line.find(separator, position), line.size());
      cells.push_back(trimmed_cell(line.substr(position, end - position)));
      position = end + 1;
    }
    return cells;
  }

  static bool is_end_of_head(const std::string_view line)
  {
    return line.find("***End_of_Header***") != std::string_view::npos;
  }

  void read_file_head()
  {
    for (std::string_view line; source.next(line) && !is_end_of_head(line);) {
      if (line.rfind("Separator", 0) == 0)
        separator = lower(line).find("comma") != std::string::npos ? ',' : '\t';
      const auto cells = cells_of(line);
      if (cells.size() < 2)
        continue;
      const auto key = choice_named<HeadKey>(cells[0]);
      if (key == HeadKey::decimal_separator)
        style.decimal = cells[1] == "," ? ',' : '.';
      if (key == HeadKey::x_columns)
        x_columns = choice_named<XColumns>(cells[1]);
      if (key == HeadKey::date && start_date.empty())
        start_date = cells[1];
      if (key == HeadKey::time && start_time.empty())
        start_time = to_microseconds(cells[1]);
    }
  }

  // LabVIEW writes more digits of a second than a time is read with.
  static std::string to_microseconds(const std::string &time)
  {
    const auto sign = time.find_first_of(".,");
    return sign == std::string::npos ? time : time.substr(0, sign + 7);
  }

  void take(const std::string_view line)
  {
    if (is_blank(line))
      return;
    const auto cells = cells_of(line);
    if (is_end_of_head(line)) {
      names_follow = true;
      return;
    }
    if (names_follow) {
      names_follow = false;
      names        = cells;
      prepare();
      return;
    }
    double number = 0;
    if (read_number(cells[0], style, number) || (cells[0].empty() && !values.empty()))
      take_row(cells);
    else
      keys[cells[0]] = {cells.begin() + 1, cells.end()};
  }

  double key_number(const std::string &key, const std::size_t channel) const
  {
    double number    = std::nan("");
    const auto entry = keys.find(key);
    if (entry != keys.end() && channel < entry->second.size())
      read_number(entry->second[channel], style, number);
    return number;
  }

  // Columns of the first run of samples; those that follow have the same.
  void prepare()
  {
    const double n = key_number("Channels", 0);
    if (!(n >= 1 && n <= 4096))
      throw InputError(place(), "the number of channels is missing above this run of samples (key Channels)");
    const auto n_channels = std::size_t(n);
    if (!values.empty() && values.size() != n_channels)
      throw InputError(place(),
                       fmt::format("this run has {} channels, the one before it {}; one file holds channels of "
                                   "one recorder",
                                   n_channels, values.size()));
    values.resize(n_channels);
    multi = x_columns == XColumns::multi;
    if (!head_place.line)
      head_place = place();
    require_same_step(n_channels);
    require_follows();
  }

  // One step for all channels and all runs.
  void require_same_step(const std::size_t n_channels)
  {
    const double before = delta;
    for (std::size_t c = 0; c < n_channels; ++c) {
      const double step = key_number("Delta_X", c);
      if (c == 0)
        delta = step;
      else if (std::abs(step - delta) > 1e-6 * std::abs(delta))
        throw InputError(place(), fmt::format("channel {} has a step of {:.6g} s, channel 1 of {:.6g} s; export "
                                              "channels of one sampling rate",
                                              c + 1, step, delta));
    }
    if (std::abs(delta - before) > 1e-6 * std::abs(before))
      throw InputError(place(), fmt::format("this run has a step of {:.6g} s, the one before it of {:.6g} s{}",
                                            delta, before, apart));
  }

  // A run begins where the one before it ends, or at the same number as the first: recorders that begin each at 0.
  void require_follows()
  {
    const double start = key_number("X0", 0);
    if (values[0].empty())
      first_start = start;
    const double end = first_start + delta * double(values[0].size());
    if (x_columns == XColumns::no && start != first_start &&
        std::abs(start - end) > 0.5 * delta + 1e-6 * std::abs(start))
      throw InputError(place(),
                       fmt::format("this run begins at {:.9g} s, where the one before it ends at {:.9g} s{}{}",
                                   start, end, no_times, apart));
    for (std::size_t c = 1; c < values.size(); ++c)
      require_same_time(c, key_number("X0", c), start, "begins at");
  }

  // Times of two channels that are said: within half a step, as channels that one converter reads in turn.
  void require_same_time(const std::size_t channel, const double time, const double of_first,
                         const char *verb) const
  {
    const double reach = (delta > 0 ? 0.5 * delta : 0) + 1e-6 * std::abs(of_first);
    if (x_columns != XColumns::one && std::abs(time - of_first) > reach)
      throw InputError(place(),
                       fmt::format("channel {} {} {:.9g} s, channel 1 {:.9g} s; export channels that were "
                                   "recorded together",
                                   channel + 1, verb, time, of_first));
  }

  std::size_t cell_of(const std::size_t channel) const
  {
    return multi ? 2 * channel + 1 : channel + 1;
  }

  void take_row(const std::vector<std::string> &cells)
  {
    for (std::size_t c = 0; c < values.size(); ++c) {
      double number          = std::nan("");
      const std::size_t cell = cell_of(c);
      const bool is_present  = cell < cells.size() && !cells[cell].empty();
      if (is_present && !read_number(cells[cell], style, number) && lower(cells[cell]) != "nan")
        throw InputError(place(),
                         fmt::format("'{}' in the column of channel {} is not a number", cells[cell], c + 1));
      values[c].push_back(number);
    }
    double x = std::nan("");
    if (x_columns != XColumns::no && read_number(cells[0], style, x))
      times.push_back(x);
    double other = 0;
    for (std::size_t c = 1; multi && c < values.size(); ++c)
      if (2 * c < cells.size() && read_number(cells[2 * c], style, other))
        require_same_time(c, other, x, "has the time");
  }

  void finish()
  {
    if (values.empty() || values[0].empty())
      throw InputError(place(), "this file holds no samples");
    const std::size_t n = values[0].size();
    if (options.rate)
      record.rate = *options.rate;
    else if (times.size() == n) {
      record.time       = Eigen::Map<const Eigen::VectorXd>(times.data(), Eigen::Index(n)).array() - times[0];
      record.first_time = times[0];
      record.time_place = head_place;
    } else if (delta > 0)
      record.rate = 1 / delta;
    else
      throw InputError(head_place, "neither a column of times nor Delta_X says the sampling rate" +
                                       by_option(options, record.file, "; give it", "--rate 20000"));
    take_start();
    const auto units = keys.find("Y_Unit_Label");
    for (std::size_t c = 0; c < values.size(); ++c) {
      const std::string name = cell_of(c) < names.size() && !names[cell_of(c)].empty()
                                   ? names[cell_of(c)]
                                   : fmt::format("channel {}", c + 1);
      ColumnHead head        = head_of(name);
      if (head.unit.empty() && units != keys.end() && c < units->second.size())
        head.unit = units->second[c];
      add_channel(record, head, head_place, options,
                  Eigen::Map<const Eigen::VectorXd>(values[c].data(), Eigen::Index(n)));
    }
    record.other_columns.push_back("X_Value");
    if (source.encoding() != TextEncoding::utf8)
      record.notes.push_back(std::string("the file is ") + word_of(source.encoding()));
    require_usable_channels(record, options, "write the units into Y_Unit_Label, or");
  }

  // Date and time of the head have no zone: they are used where --zone names one.
  void take_start()
  {
    if (options.zone.empty() || start_date.empty() || start_time.empty())
      return;
    RecordClock clock(options);
    clock.seconds_of(start_date + " " + start_time, {record.file, 1, 1});
    record.start = clock.start();
  }

  LineSource source;
  const ReadOptions &options;
  RawRecord record;
  char separator = '\t';
  NumberStyle style;
  std::optional<XColumns> x_columns = XColumns::one;
  std::string start_date, start_time;
  std::map<std::string, std::vector<std::string>> keys;
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  std::vector<double> times;
  Place head_place;
  double delta = std::numeric_limits<double>::quiet_NaN(), first_start = 0;  // s
  bool names_follow = false, multi = false;
};
}  // namespace

RawRecord read_lvm_record(const std::string &path, const ReadOptions &options)
{
  return LvmReader(path, options).read();
}
}  // namespace mill::twin
