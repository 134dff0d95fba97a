#include "core/base/files.h"
#include "core/base/valid_text.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/channel_names.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <set>

// Universal file format, data set 58 (function at nodal degree of freedom) as text and 58b (numbers in binary).
// Source: SDRC, Universal File Formats, data set 58, as handed on by the University of Cincinnati.
namespace mill::twin {
namespace {
constexpr std::size_t header_lines = 11;  // of a data set, behind its number

// A file as lines, with room for binary numbers between them.
class UffText {
public:
  UffText(const std::string &path, std::string bytes) : file(path), text(std::move(bytes)) {}
  bool next(std::string_view &line)
  {
    if (position >= text.size())
      return false;
    const auto end = std::min(text.find('\n', position), text.size());
    line           = std::string_view(text).substr(position, end - position);
    position       = std::min(end + 1, text.size());
    ++number;
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    return true;
  }
  // So many bytes as a head says, which may be any number.
  std::string_view bytes(const double wanted_bytes)
  {
    if (!(wanted_bytes <= double(text.size() - position)))
      throw InputError(here(),
                       fmt::format("the file ends inside the {} byte of numbers that follow here", wanted_bytes));
    const auto n    = std::size_t(std::max(0.0, wanted_bytes));
    const auto view = std::string_view(text).substr(position, n);
    number += int(std::count(view.begin(), view.end(), '\n'));
    position += n;
    return view;
  }
  Place here() const
  {
    return {file, number, 1};
  }
  const std::string &path() const
  {
    return file;
  }

private:
  std::string file, text;
  std::size_t position = 0;
  int number           = 0;
};

std::string_view part(const std::string_view line, const std::size_t from, const std::size_t n)
{
  auto text = from < line.size() ? line.substr(from, n) : std::string_view();
  while (!text.empty() && text.front() == ' ')
    text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ')
    text.remove_suffix(1);
  return text;
}

// The line before and after a data set.
bool is_border(const std::string_view line)
{
  return part(line, 0, 80) == "-1";
}

// A number of fixed width, "1.5D-03" as Fortran writes it too.
bool number_in(const std::string_view text, double &value)
{
  std::string copy(text);
  std::replace(copy.begin(), copy.end(), 'D', 'E');
  std::replace(copy.begin(), copy.end(), 'd', 'e');
  char *end = nullptr;
  value     = std::strtod(copy.c_str(), &end);
  return !copy.empty() && end == copy.c_str() + copy.size();
}

struct DataSet {
  std::vector<std::string> names;  // by ID lines 1 and 5, by entity, by node and direction; empty: not said
  std::string unit, axis, axis_unit;
  bool binary = false, big_endian = false, even = true;
  double n_bytes = 0, first = 0, step = 0;
  int function = 0, type = 0, axis_kind = 0;
  Eigen::Index n = 0;
  Place place;

  // Function type 1 is a time response; type 0, a general function, is one where its abscissa is a time.
  bool is_time_record() const
  {
    constexpr int time_axis = 17;
    const bool over_time    = axis_kind == time_axis || lower(axis) == "time" || seconds_per(axis_unit) > 0;
    const bool over_other   = !over_time && axis_kind != 0 && axis_kind != 1;
    return (type == 2 || type == 4) && ((function == 1 && !over_other) || (function == 0 && over_time));
  }
  double seconds_per_step() const
  {
    const double seconds = seconds_per(axis_unit);
    return seconds > 0 ? seconds : 1;
  }
};

std::string without_none(const std::string_view text)
{
  return text == "NONE" ? std::string() : valid_text(text);
}

// "+X" of direction 1, as the description numbers them.
std::string direction_name(const std::string_view code)
{
  static constexpr std::pair<std::string_view, const char *> directions[] = {
      {"1", "+X"}, {"-1", "-X"}, {"2", "+Y"}, {"-2", "-Y"}, {"3", "+Z"}, {"-3", "-Z"}};
  for (const auto &[number, name] : directions)
    if (code == number)
      return name;
  return code == "0" || code.empty() ? "" : std::string(code);
}

class UffReader {
public:
  UffReader(const std::string &path, const ReadOptions &read_options)
      : text(path, read_text(path)), options(read_options)
  {
    record.file   = path;
    record.format = "UFF 58";
  }

  RawRecord read()
  {
    std::string_view line;
    bool any = false;
    while (text.next(line)) {
      if (!is_border(line))
        continue;
      if (!text.next(line))
        break;
      any               = true;
      const auto number = part(line, 0, 6);
      if (number == "58")
        take_function(line);
      else {
        ++n_other;
        skip_set();
      }
    }
    if (!any)
      throw InputError(Place{text.path(), 1, 1},
                       "this is not a universal file: no line with -1 begins a data set");
    finish();
    return std::move(record);
  }

private:
  void skip_set()
  {
    std::string_view line;
    while (text.next(line))
      if (is_border(line))
        return;
  }

  double wanted(const std::string_view field, const char *what)
  {
    double value = 0;
    if (!number_in(field, value))
      throw InputError(text.here(), fmt::format("'{}' is not a {}", valid_text(field), what));
    return value;
  }

  // A code; -1, which no list has, where the number cannot be one.
  int whole(const std::string_view field, const char *what)
  {
    const double value = wanted(field, what);
    return value > -1e9 && value < 1e9 ? int(value) : -1;
  }

  DataSet head(const std::string_view first_line)
  {
    DataSet set;
    set.place = text.here();
    if (first_line.size() > 6 && (first_line[6] == 'b' || first_line[6] == 'B')) {
      set.binary     = true;
      set.big_endian = wanted(part(first_line, 7, 6), "byte order") == 2;
      set.n_bytes    = wanted(part(first_line, 31, 12), "number of bytes");
      if (wanted(part(first_line, 13, 6), "floating point format") != 2)
        throw InputError(text.here(), "the numbers are not in the format IEEE 754; export them so, or as text");
      record.format = "UFF 58b";
    }
    std::array<std::string, header_lines> lines;
    std::string_view line;
    for (auto &one : lines) {
      if (!text.next(line))
        throw InputError(text.here(), "the file ends inside the head of a data set");
      one                 = std::string(line);
      const auto &l       = one;
      const std::size_t i = std::size_t(&one - lines.data());
      if (i == 5)
        set.function = whole(part(l, 0, 5), "kind of function");
      if (i == 6) {
        set.type       = whole(part(l, 0, 10), "type of number");
        const double n = wanted(part(l, 10, 10), "number of samples");
        set.even       = wanted(part(l, 20, 10), "kind of spacing") == 1;
        set.first      = wanted(part(l, 30, 13), "first abscissa");
        set.step       = wanted(part(l, 43, 13), "step of the abscissa");
        if (!(n >= 0) || n > 2e9)
          throw InputError(text.here(), fmt::format("{} samples are not possible", n));
        set.n = Eigen::Index(n);
      }
      if (i == 7)
        set.axis_kind = whole(part(l, 0, 10), "kind of axis");
      if (i == 7) {
        set.axis      = without_none(part(l, 26, 21));
        set.axis_unit = without_none(part(l, 47, 21));
      }
      if (i == 8)
        set.unit = without_none(part(l, 47, 21));
    }
    const auto entity = without_none(part(lines[5], 30, 11)), node = without_none(part(lines[5], 41, 10));
    const auto direction      = direction_name(part(lines[5], 51, 4));
    const auto with_direction = [&](const std::string &name) {
      return name.empty() || direction.empty() ? name : name + " " + direction;
    };
    set.names = {without_none(part(lines[0], 0, 80)), without_none(part(lines[4], 0, 80)), entity,
                 with_direction(entity), with_direction("node " + node)};
    return set;
  }

  std::vector<double> numbers(const DataSet &set, const std::size_t n)
  {
    const bool is_double = set.type == 4;
    std::vector<double> values;
    if (set.binary) {
      const BinaryType type{'f', is_double ? 8 : 4, set.big_endian};
      const std::size_t size = n * std::size_t(type.size);
      if (set.n_bytes > 0 && set.n_bytes < double(size))
        throw InputError(set.place,
                         fmt::format("the head says {} byte, {} samples need {}", set.n_bytes, set.n, size));
      const auto bytes = text.bytes(set.n_bytes > 0 ? set.n_bytes : double(size));
      values.reserve(n);
      for (std::size_t i = 0; i < n; ++i)
        values.push_back(number_at(bytes.data() + i * std::size_t(type.size), type));
      return values;
    }
    std::string_view line;
    while (values.size() < n) {
      if (!text.next(line))
        throw InputError(text.here(), fmt::format("the file ends after {} of {} numbers", values.size(), n));
      if (is_border(line))
        throw InputError(text.here(), fmt::format("the data set ends after {} of {} numbers", values.size(), n));
      take_line(line, set, is_double, n, values);
    }
    return values;
  }

  // Fixed widths, since neighbours may touch: 6E13.5, 4E20.12, or pairs of abscissa and ordinate, E13.5 and E20.12
  // by the description and twice E20.12 or E13.5 by some programs.  The length of the line and its numbers say
  // which.
  void take_line(const std::string_view line, const DataSet &set, const bool is_double, const std::size_t n,
                 std::vector<double> &values)
  {
    if (set.even)
      return take_fields(line, is_double ? 20 : 13, is_double ? 20 : 13, n, values);
    const auto end = line.find_last_not_of(' ');
    for (const auto &[abscissa, ordinate] : widths_of_pairs(is_double))
      if (fits(line.substr(0, end + 1), abscissa, ordinate))
        return take_fields(line, abscissa, ordinate, n, values);
    const auto [abscissa, ordinate] = widths_of_pairs(is_double).front();
    take_fields(line, abscissa, ordinate, n, values);
  }

  static std::vector<std::pair<std::size_t, std::size_t>> widths_of_pairs(const bool is_double)
  {
    if (is_double)
      return {{13, 20}, {20, 20}, {20, 13}, {25, 25}};
    return {{13, 13}, {20, 13}, {20, 20}};
  }

  static bool fits(const std::string_view line, const std::size_t abscissa, const std::size_t ordinate)
  {
    double ignored       = 0;
    bool first           = true;
    std::size_t position = 0;
    for (; position < line.size(); first = !first) {
      const std::size_t width = first ? abscissa : ordinate;
      if (!number_in(part(line, position, width), ignored) ||
          (position + width < line.size() && line[position + width - 1] == ' '))
        return false;
      position += width;
    }
    return position == line.size() && first;
  }

  void take_fields(const std::string_view line, const std::size_t abscissa, const std::size_t ordinate,
                   const std::size_t n, std::vector<double> &values)
  {
    for (std::size_t position = 0; position < line.size() && values.size() < n;) {
      const std::size_t width = values.size() % 2 == 0 ? abscissa : ordinate;
      const auto field        = part(line, position, width);
      if (field.empty())
        break;
      double value = 0;
      if (!number_in(field, value))
        throw InputError({text.path(), text.here().line, int(position) + 1},
                         fmt::format("'{}' is not a number", valid_text(field)));
      values.push_back(value);
      position += width;
    }
  }

  void take_function(const std::string_view first_line)
  {
    const DataSet set = head(first_line);
    if (!set.is_time_record()) {
      ++n_other;
      if (set.binary)
        text.bytes(set.n_bytes);
      skip_set();
      return;
    }
    const std::size_t n_numbers = std::size_t(set.n) * (set.even ? 1 : 2);
    const auto values           = numbers(set, n_numbers);
    std::string_view line;
    if (set.binary)  // some writers put no line end behind the numbers
      while (text.next(line) && !is_border(line))
        if (!part(line, 0, 80).empty())
          throw InputError(
              text.here(),
              "the numbers of this data set are not followed by -1; their count in the head is wrong");
    if (!set.binary)
      skip_set();
    add_set(set, values);
  }

  void add_set(const DataSet &set, const std::vector<double> &values)
  {
    Eigen::VectorXd time, value(set.n);
    if (set.even)
      value = Eigen::Map<const Eigen::VectorXd>(values.data(), set.n);
    else {
      const Eigen::Map<const Eigen::Matrix2Xd> pairs(values.data(), 2, set.n);
      time  = (pairs.row(0).transpose().array() - (set.n > 0 ? pairs(0, 0) : 0.0)) * set.seconds_per_step();
      value = pairs.row(1).transpose();
    }
    const double begin = set.even || set.n == 0 ? set.first : values[0];
    if (sets.empty()) {
      record.first_time = options.rate || set.even || set.n == 0 ? 0 : values[0] * set.seconds_per_step();
      record.time_place = set.place;
      times             = time;
      first_abscissa    = begin;
      if (options.rate)
        record.rate = *options.rate;
      else if (set.even)
        record.rate = rate_of(set);
    } else if (const DataSet &first = sets.front();
               set.n != first.n || set.step != first.step || time.size() != times.size())
      throw InputError(set.place,
                       fmt::format("'{}' has {} samples with a step of {:.5e} s, '{}' before it {} with "
                                   "{:.5e} s; one file holds channels of one recorder",
                                   first_name(set), set.n, set.step, first_name(first), first.n, first.step));
    else if (!options.rate)
      require_same_times(set, time, begin);
    sets.push_back(set);
    samples.push_back(std::move(value));
  }

  // All channels have the times of the first one, within a hundredth of a step and what six digits resolve.
  void require_same_times(const DataSet &set, const Eigen::VectorXd &time, const double begin)
  {
    const DataSet &first = sets.front();
    const double seconds = set.seconds_per_step(), last = time.size() > 1 ? time[time.size() - 1] : 0,
                 step    = time.size() > 1 ? last / double(time.size() - 1) : set.step * seconds,
                 start   = first_abscissa * first.seconds_per_step(),
                 reach   = 0.01 * step + 2e-5 * (last + std::abs(start));
    const bool same_unit = seconds == first.seconds_per_step();
    const bool begins    = std::abs(begin * seconds - start) <= reach;
    if (!same_unit || !begins || (time.size() > 0 && (time - times).cwiseAbs().maxCoeff() > reach))
      throw InputError(
          set.place,
          fmt::format(
              "'{}' has other times than '{}' before it{}; one file holds channels that were "
              "recorded together",
              first_name(set), first_name(first),
              begins ? "" : fmt::format(", it begins at {:.6g} s and not at {:.6g} s", begin * seconds, start)));
  }

  static std::string first_name(const DataSet &set)
  {
    const auto entry =
        std::find_if(set.names.begin(), set.names.end(), [](const auto &name) { return !name.empty(); });
    return entry == set.names.end() ? "data set" : *entry;
  }

  double rate_of(const DataSet &set)
  {
    const double seconds = set.step * set.seconds_per_step();
    if (!(seconds > 0))
      throw InputError(set.place,
                       "the step of the time is zero" +
                           by_option(options, text.path(), "; give the samples per second", "--rate 20000"));
    const double rate = 1 / seconds, whole = std::round(rate);
    if (std::abs(rate - whole) < 6e-6 * whole && rate != whole) {
      record.notes.push_back(fmt::format(
          "the step of {:.5e} s has six digits; {:.0f} samples per second were taken", seconds, whole));
      return whole;
    }
    return rate;
  }

  // The first of ID line 1, ID line 5, entity, node and direction that is said and different in all data sets.
  std::size_t way_of_names() const
  {
    for (std::size_t way = 0; way < sets.front().names.size(); ++way) {
      std::set<std::string> seen;
      for (const DataSet &set : sets)
        if (!set.names[way].empty())
          seen.insert(set.names[way]);
      if (seen.size() == sets.size())
        return way;
    }
    return sets.front().names.size();
  }

  void add_channels()
  {
    const std::size_t way               = way_of_names();
    static constexpr const char *ways[] = {"", "ID line 5", "the entity", "entity and direction",
                                           "node and direction"};
    if (way > 0 && way < std::size(ways) && !sets.front().names[0].empty())
      record.notes.push_back(
          fmt::format("ID line 1 is the same in several data sets; the channels have their names "
                      "from {}",
                      ways[way]));
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const std::string name = way < sets[i].names.size() ? sets[i].names[way] : first_name(sets[i]);
      add_channel(record, {name, sets[i].unit}, sets[i].place, options, std::move(samples[i]));
    }
  }

  void finish()
  {
    if (n_other > 0)
      record.notes.push_back(fmt::format("{} data set{} that hold{} no time record {} not used", n_other,
                                         n_other == 1 ? "" : "s", n_other == 1 ? "s" : "",
                                         n_other == 1 ? "was" : "were"));
    if (sets.empty())
      throw InputError(
          Place{text.path(), 1, 1},
          "no data set 58 of this file is a real time response (function type 1, or 0 over a time); export "
          "the time records, not spectra");
    if (!options.rate)
      record.time = std::move(times);
    add_channels();
    require_usable_channels(record, options, "export the label of the ordinate's unit, for example g or m/s2, or");
  }

  UffText text;
  const ReadOptions &options;
  RawRecord record;
  std::vector<DataSet> sets;             // that are channels
  std::vector<Eigen::VectorXd> samples;  // of each
  Eigen::VectorXd times;                 // s from the first one; empty: even
  double first_abscissa = 0;
  int n_other           = 0;
};
}  // namespace

RawRecord read_uff_record(const std::string &path, const ReadOptions &options)
{
  return UffReader(path, options).read();
}
}  // namespace mill::twin
