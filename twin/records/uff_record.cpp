#include "core/base/files.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/channel_names.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

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
    if (at >= text.size())
      return false;
    const auto end = std::min(text.find('\n', at), text.size());
    line           = std::string_view(text).substr(at, end - at);
    at             = std::min(end + 1, text.size());
    ++number;
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    return true;
  }
  std::string_view bytes(const std::size_t n)
  {
    if (text.size() - at < n)
      throw InputError(here(), fmt::format("the file ends inside the {} byte of numbers that follow here", n));
    const auto view = std::string_view(text).substr(at, n);
    number += int(std::count(view.begin(), view.end(), '\n'));
    at += n;
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
  std::size_t at = 0;
  int number     = 0;
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
  std::string name, unit, axis;
  bool binary = false, big_endian = false, even = true;
  double n_bytes = 0, first = 0, step = 0;
  int function = 0, type = 0, axis_kind = 0;
  Eigen::Index n = 0;
  Place place;
};

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
      if (part(line, 0, 80) != "-1")
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
      throw InputError(Place{text.path(), 1, 1}, "this is no universal file: no line with -1 begins a data set");
    finish();
    return std::move(record);
  }

private:
  void skip_set()
  {
    std::string_view line;
    while (text.next(line))
      if (part(line, 0, 80) == "-1")
        return;
  }

  double wanted(const std::string_view field, const char *what)
  {
    double value = 0;
    if (!number_in(field, value))
      throw InputError(text.here(), fmt::format("'{}' is no {}", field, what));
    return value;
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
        set.function = int(wanted(part(l, 0, 5), "kind of function"));
      if (i == 6) {
        set.type       = int(wanted(part(l, 0, 10), "type of number"));
        const double n = wanted(part(l, 10, 10), "number of samples");
        set.even       = wanted(part(l, 20, 10), "kind of spacing") == 1;
        set.first      = wanted(part(l, 30, 13), "first abscissa");
        set.step       = wanted(part(l, 43, 13), "step of the abscissa");
        if (!(n >= 0) || n > 2e9)
          throw InputError(text.here(), fmt::format("{} samples are not possible", n));
        set.n = Eigen::Index(n);
      }
      if (i == 7)
        set.axis_kind = int(wanted(part(l, 0, 10), "kind of axis"));
      if (i == 8) {
        set.axis = std::string(part(l, 26, 21));
        set.unit = std::string(part(l, 47, 21));
      }
    }
    const std::string id(part(lines[0], 0, 80)), place(part(lines[5], 30, 11));
    const std::string node(part(lines[5], 41, 10)), direction(part(lines[5], 51, 4));
    set.name = !id.empty() && id != "NONE"         ? id
               : !place.empty() && place != "NONE" ? place
                                                   : "node " + node + " " + direction;
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
      const auto bytes = text.bytes(set.n_bytes > 0 ? std::size_t(set.n_bytes) : size);
      values.reserve(n);
      for (std::size_t i = 0; i < n; ++i)
        values.push_back(number_at(bytes.data() + i * std::size_t(type.size), type));
      return values;
    }
    std::string_view line;
    while (values.size() < n) {
      if (!text.next(line))
        throw InputError(text.here(), fmt::format("the file ends after {} of {} numbers", values.size(), n));
      if (part(line, 0, 80) == "-1")
        throw InputError(text.here(), fmt::format("the data set ends after {} of {} numbers", values.size(), n));
      take_line(line, set, is_double, n, values);
    }
    return values;
  }

  // Fixed widths, since neighbours may touch: 6E13.5, 4E20.12, or 2(E13.5, E20.12) with an abscissa.
  void take_line(const std::string_view line, const DataSet &set, const bool is_double, const std::size_t n,
                 std::vector<double> &values)
  {
    for (std::size_t at = 0; at < line.size() && values.size() < n;) {
      const bool abscissa     = !set.even && values.size() % 2 == 0;
      const std::size_t width = is_double && !abscissa ? 20 : 13;
      const auto field        = part(line, at, width);
      if (field.empty())
        break;
      double value = 0;
      if (!number_in(field, value))
        throw InputError({text.path(), text.here().line, int(at) + 1}, fmt::format("'{}' is no number", field));
      values.push_back(value);
      at += width;
    }
  }

  void take_function(const std::string_view first_line)
  {
    const DataSet set = head(first_line);
    if (set.function != 1 || (set.type != 2 && set.type != 4)) {
      ++n_other;
      if (set.binary)
        text.bytes(std::size_t(std::max(0.0, std::min(set.n_bytes, 1e12))));
      skip_set();
      return;
    }
    const std::size_t n_numbers = std::size_t(set.n) * (set.even ? 1 : 2);
    const auto values           = numbers(set, n_numbers);
    std::string_view line;
    if (set.binary)  // some writers put no line end behind the numbers
      while (text.next(line) && part(line, 0, 80) != "-1")
        if (!part(line, 0, 80).empty())
          throw InputError(
              text.here(),
              "the numbers of this data set are not followed by -1; their count in the head is wrong");
    if (!set.binary)
      skip_set();
    add_channel(set, values);
  }

  void add_channel(const DataSet &set, const std::vector<double> &values)
  {
    Eigen::VectorXd time, value(set.n);
    if (set.even)
      value = Eigen::Map<const Eigen::VectorXd>(values.data(), set.n);
    else {
      const Eigen::Map<const Eigen::Matrix2Xd> pairs(values.data(), 2, set.n);
      time  = pairs.row(0).transpose().array() - (set.n > 0 ? pairs(0, 0) : 0.0);
      value = pairs.row(1).transpose();
    }
    if (record.channels.empty()) {
      record.time       = time;
      record.time_place = set.place;
      step              = set.step;
      if (set.even) {
        if (!(set.step > 0) && !options.rate)
          throw InputError(set.place,
                           "the step of the time is zero; give the samples per second with --rate 20000");
        record.rate        = options.rate ? *options.rate : 1 / set.step;
        const double whole = std::round(record.rate);
        if (!options.rate && std::abs(record.rate - whole) < 6e-6 * whole && record.rate != whole) {
          record.notes.push_back(fmt::format(
              "the step of {:.5e} s has six digits; {:.0f} samples per second were taken", set.step, whole));
          record.rate = whole;
        }
      }
    } else if (value.size() != record.n_samples() || set.step != step || time.size() != record.time.size())
      throw InputError(set.place,
                       fmt::format("'{}' has {} samples with a step of {:.5e} s, '{}' before it {} with "
                                   "{:.5e} s; one file holds channels of one recorder",
                                   set.name, set.n, set.step, record.channels.front().column, record.n_samples(),
                                   step));
    record.channels.push_back(
        channel_of({set.name, set.unit == "NONE" ? "" : set.unit}, set.place, options, std::move(value)));
  }

  void finish()
  {
    if (n_other > 0)
      record.notes.push_back(fmt::format("{} data set{} that hold{} no time record {} not used", n_other,
                                         n_other == 1 ? "" : "s", n_other == 1 ? "s" : "",
                                         n_other == 1 ? "was" : "were"));
    if (record.channels.empty())
      throw InputError(Place{text.path(), 1, 1},
                       "no data set 58 of this file is a real time response (function type 1); export the time "
                       "records, not spectra");
    require_usable_channels(record, "export the label of the ordinate's unit, for example g or m/s2");
  }

  UffText text;
  const ReadOptions &options;
  RawRecord record;
  double step = 0;
  int n_other = 0;
};
}  // namespace

RawRecord read_uff_record(const std::string &path, const ReadOptions &options)
{
  return UffReader(path, options).read();
}
}  // namespace mill::twin
