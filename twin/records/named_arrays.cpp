#include "twin/records/named_arrays.h"
#include "core/base/valid_text.h"
#include "twin/records/channel_names.h"
#include "twin/records/sampling_rate.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr Eigen::Index most_columns = 4096;

struct Vector {
  std::string name;
  Eigen::VectorXd value;
};

// "run.a" becomes "a" where no other array ends so.
void shorten_names(std::vector<NamedArray> &arrays)
{
  const auto last = [](const std::string &name) { return name.substr(name.find_last_of('.') + 1); };
  std::map<std::string, int> uses;
  for (NamedArray &array : arrays) {
    array.name = valid_text(array.name);
    ++uses[last(array.name)];
  }
  for (NamedArray &array : arrays)
    if (uses[last(array.name)] == 1)
      array.name = last(array.name);
}

std::string shape_text(const NamedArray &array)
{
  return fmt::format("'{}' ({} x {})", array.name, array.value.rows(), array.value.cols());
}

Eigen::Index length_of(const Eigen::MatrixXd &value)
{
  return std::max(value.rows(), value.cols());
}

class ArrayReader {
public:
  ArrayReader(const std::string &path, const std::string &format,
              const std::map<std::string, std::string> &its_units, const ReadOptions &read_options)
      : units(its_units), options(read_options)
  {
    record.file       = path;
    record.format     = format;
    record.time_place = {path, 0, 0};
  }

  RawRecord read(NamedArrays &&all)
  {
    shorten_names(all.arrays);
    take_arrays(all);
    const int time = time_among();
    const double time_rate =
        time >= 0 ? double(n - 1) / (vectors[std::size_t(time)].value[n - 1] - vectors[std::size_t(time)].value[0])
                  : std::nan("");
    decide_rate(time, time_rate);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      Vector &vector = vectors[i];
      if (int(i) == time && !options.rate) {
        record.time       = (vector.value.array() - vector.value[0]) * per_unit(vector.name);
        record.first_time = vector.value[0] * per_unit(vector.name);
      }
      if (int(i) == time)
        record.other_columns.push_back(vector.name);
      else
        add_channel(record, {vector.name, unit_of(vector.name)}, {record.file, 0, 0}, options,
                    std::move(vector.value));
    }
    require_usable_channels(record, options, "name the units, for example");
    return std::move(record);
  }

private:
  std::string unit_of(const std::string &name) const
  {
    const auto given = options.units.find(name);
    const auto noted = units.find(name);
    return given != options.units.end() ? given->second
           : noted != units.end()       ? noted->second
                                        : head_of(name).unit;  // t_ms
  }

  double per_unit(const std::string &name) const
  {
    const double seconds = seconds_per(unit_of(name));
    return seconds > 0 ? seconds : 1;
  }

  // Vectors and columns as long as the longest; single numbers may be the sampling rate.
  void take_arrays(NamedArrays &all)
  {
    for (const NamedArray &array : all.arrays)
      n = std::max(n, length_of(array.value));
    if (n < 2) {
      std::vector<std::string> names = all.others;
      for (const NamedArray &array : all.arrays)
        names.push_back(shape_text(array));
      constexpr std::size_t most_names = 20;
      if (names.size() > most_names) {
        names.resize(most_names);
        names.push_back("..");
      }
      throw InputError(
          fmt::format("{} holds no numeric vector; it holds {}; save the channels as vectors of numbers",
                      record.file, names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "))));
    }
    for (NamedArray &array : all.arrays)
      take_array(array);
    if (!all.others.empty())
      record.notes.push_back(
          fmt::format("not used, because not an array of real numbers: {}", fmt::join(all.others, ", ")));
  }

  void take_array(NamedArray &array)
  {
    const Eigen::Index columns = std::min(array.value.rows(), array.value.cols());
    if (array.value.size() == 1) {
      numbers.push_back({array.name, array.value(0, 0)});
      record.other_columns.push_back(array.name);
    } else if (length_of(array.value) != n || columns > most_columns) {
      record.notes.push_back(fmt::format("{} was not used: its length is not {}", shape_text(array), n));
      record.other_columns.push_back(array.name);
    } else if (columns == 1) {
      vectors.push_back({array.name, Eigen::Map<Eigen::VectorXd>(array.value.data(), n)});
    } else {
      record.notes.push_back(fmt::format("the {} columns of the matrix '{}' are called {}_1 to {}_{}", columns,
                                         array.name, array.name, array.name, columns));
      for (Eigen::Index c = 0; c < columns; ++c)
        vectors.push_back({fmt::format("{}_{}", array.name, c + 1),
                           array.value.rows() == n ? Eigen::VectorXd(array.value.col(c))
                                                   : Eigen::VectorXd(array.value.row(c).transpose())});
    }
    array.value.resize(0, 0);
  }

  // The vector of times, -1: none.  One without a unit is taken in seconds where no number says the rate.
  int time_among() const
  {
    const bool rate_given =
        options.rate || std::any_of(numbers.begin(), numbers.end(), [](const RateCandidate &c) {
          const RateName kind = rate_name(c.name);
          return kind == RateName::frequency || kind == RateName::step;
        });
    std::vector<TimeEvidence> evidence;
    for (const Vector &vector : vectors) {
      const auto steps = vector.value.tail(n - 1) - vector.value.head(n - 1);
      const bool rises = (steps.array() >= 0).all() && vector.value[n - 1] > vector.value[0];
      const bool axis  = time_name(vector.name) == TimeName::weak && seconds_per(unit_of(vector.name)) == 0;
      // x without a unit is an axis of a sensor; t that goes up and down is a temperature where the rate is known.
      evidence.push_back(axis || (rate_given && !rises)
                             ? TimeEvidence{}
                             : TimeEvidence{vector.name, unit_of(vector.name), false, rises});
    }
    return time_column_among(evidence);
  }

  void decide_rate(const int time, const double time_rate)
  {
    const std::string name = time >= 0 ? vectors[std::size_t(time)].name : "";
    const bool rises       = time_rate > 0 && std::isfinite(time_rate);
    record.rate = sampling_rate(record.file, numbers, name, rises ? time_rate / per_unit(name) : std::nan(""),
                                options, record.notes);
    if (time >= 0 && !options.rate) {
      if (unit_of(name).empty())
        record.notes.push_back(fmt::format("the time '{}' has no unit and was taken in seconds", name));
      record.rate = std::numeric_limits<double>::quiet_NaN();
      return;
    }
    if (record.rate > 0)
      return;
    std::string seen;
    for (const RateCandidate &one : numbers)
      seen += fmt::format("{}'{}' = {:.6g}", seen.empty() ? "" : ", ", one.name, one.number);
    std::vector<std::string> names;
    for (const Vector &vector : vectors)
      names.push_back(vector.name);
    if (const std::string clock = rising_evenly(); !clock.empty())
      throw InputError(
          fmt::format("{}: the sampling rate is missing; '{}' rises by the same step from sample to sample: "
                      "{}",
                      record.file, clock,
                      options.from_case ? "if it is the time in seconds, name it 'time'; else add the number Fs"
                                        : "if it is the time in seconds, " +
                                              command_with(options, record.file, "--unit " + clock + "=s") +
                                              ", else give the samples per second with --rate"));
    throw InputError(
        fmt::format("{}: the sampling rate is missing: there is neither a vector 'time' in seconds nor a "
                    "number Fs, sr, SampleRate, dt or Ts{}; the vectors are {}{}",
                    record.file, seen.empty() ? "" : ", and " + seen + " is not taken for it", listed(names),
                    by_option(options, record.file, "; give the samples per second", "--rate 20000")));
  }

  // Name of a vector with equal steps that are not whole numbers, as a time has them; "" where there is none.
  std::string rising_evenly() const
  {
    for (const Vector &vector : vectors) {
      const double step = (vector.value[n - 1] - vector.value[0]) / double(n - 1);
      const auto steps  = vector.value.tail(n - 1) - vector.value.head(n - 1);
      if (step > 0 && step != std::round(step) && ((steps.array() - step).abs() < 0.01 * step).all())
        return vector.name;
    }
    return "";
  }

  RawRecord record;
  const std::map<std::string, std::string> &units;
  const ReadOptions &options;
  Eigen::Index n = 0;
  std::vector<Vector> vectors;
  std::vector<RateCandidate> numbers;
};
}  // namespace

RawRecord record_of_arrays(const std::string &path, const std::string &format, NamedArrays &&arrays,
                           const std::map<std::string, std::string> &units, const ReadOptions &options)
{
  return ArrayReader(path, format, units, options).read(std::move(arrays));
}
}  // namespace mill::twin
