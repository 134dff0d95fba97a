#include "twin/records/force_record.h"
#include "twin/records/channel_names.h"
#include "twin/records/known_channel.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double most_doubled = 0.01;  // share of the samples, as in an analysis

std::string names_of(const RawRecord &record)
{
  std::vector<std::string> names;
  for (const RawChannel &channel : record.channels)
    names.push_back(channel.column);
  return listed(names);
}

Place head_of_record(const RawRecord &record)
{
  return record.channels.empty() ? Place{record.file, 1, 1} : record.channels.front().place;
}

const RawChannel &acceleration_channel(const RawRecord &record, const char *name)
{
  const RawChannel *channel = record.find(name);
  if (!channel)
    throw InputError(head_of_record(record),
                     fmt::format("no column '{}' in this record, which has {}; name the column of the roll's "
                                 "acceleration \"{} [g]\"",
                                 name, names_of(record), name));
  if (channel->quantity != Quantity::acceleration)
    throw InputError(
        channel->place,
        fmt::format("the unit of column '{}' is {}; an acceleration is needed, for example \"{} [g]\"", name,
                    channel->unit.empty() ? "not given" : "'" + channel->unit + "'", name));
  return *channel;
}

double time_of(const RawRecord &record, const Eigen::Index i)
{
  return record.time.size() > 0 ? record.first_time + record.time[i] : record.first_time + double(i) / record.rate;
}

struct DrivingSamples {
  std::vector<double> time, first, second;  // s, values of the columns
  std::vector<std::string> notes;
};

// Of one column, or of two that have their samples together.
DrivingSamples samples_of(const RawRecord &record, const Eigen::VectorXd &first, const Eigen::VectorXd &second)
{
  DrivingSamples samples;
  SampleFeed feed(record.time_place.file.empty() ? head_of_record(record) : record.time_place);
  for (Eigen::Index i = 0; i < record.n_samples(); ++i)
    feed.take(time_of(record, i), {first[i], second[i]}, [&](const double time, const SampleFeed::Values &values) {
      samples.time.push_back(time);
      samples.first.push_back(values[0]);
      samples.second.push_back(values[1]);
    });
  samples.notes     = record.notes;
  const auto faults = feed.finish();
  samples.notes.insert(samples.notes.end(), faults.begin(), faults.end());
  return samples;
}

Eigen::VectorXd vector_of(const std::vector<double> &numbers)
{
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
}
}  // namespace

ReadOptions options_of_case_record()
{
  ReadOptions options;
  options.from_case      = true;
  options.fewest_samples = 2;
  return options;
}

std::size_t force_channel(const RawRecord &record)
{
  std::vector<std::size_t> forces;
  for (std::size_t i = 0; i < record.channels.size(); ++i) {
    const RawChannel &channel = record.channels[i];
    if (is_driving_force(channel.name)) {
      if (channel.quantity == Quantity::force)
        return i;
      throw InputError(
          channel.place,
          fmt::format("the unit of column 'force' is {}; a force is needed, for example \"force [kN]\"",
                      channel.unit.empty() ? "not given" : "'" + channel.unit + "'"));
    }
    if (channel.quantity == Quantity::force)
      forces.push_back(i);
  }
  if (forces.size() == 1)
    return forces.front();
  throw InputError(
      head_of_record(record),
      forces.empty()
          ? fmt::format("no column of this record holds a force; its columns are {}; name the one of the "
                        "rolling force \"force [kN]\"",
                        names_of(record))
          : fmt::format("{} columns of this record hold forces, and none has the name 'force'; its "
                        "columns are {}; name the one of the whole rolling force \"force [kN]\"",
                        forces.size(), names_of(record)));
}

SampleFeed::SampleFeed(Place column) : column_(std::move(column)) {}

// Is this a sample with values, later than the last one?
bool SampleFeed::accepts(const double time, const Values &values)
{
  if (n_used_ > 0 && time < last_)
    throw InputError(column_,
                     fmt::format("the time goes backwards, from {:.9g} s to {:.9g} s; sort the samples by "
                                 "time",
                                 last_, time));
  if ((n_used_ > 0 && time == last_) || (!pending_.empty() && time <= pending_.back())) {
    ++n_doubled_;
    last_doubled_ = time;
    return false;
  }
  if (std::isnan(values[0]) || std::isnan(values[1])) {
    ++n_missing_;
    if (n_used_ > 0 && pending_.size() <= longest_filled)
      pending_.push_back(time);
    return false;
  }
  return true;
}

std::vector<std::string> SampleFeed::finish() const
{
  if (n_used_ < 2)
    throw InputError(column_, fmt::format("{} in this record; at least two are needed",
                                          n_used_ == 0 ? "no sample" : "only one sample"));
  if (double(n_doubled_) > most_doubled * double(n_used_ + n_doubled_))
    throw InputError(column_,
                     fmt::format("{} of {} samples have the time of their neighbour, the last at {:.9g} s; "
                                 "keep one of each, or export the time with more digits",
                                 n_doubled_, n_used_ + n_doubled_, last_doubled_));
  std::vector<std::string> notes;
  if (n_doubled_ > 0)
    notes.push_back(fmt::format("{} sample{} with the time of their neighbour left out", n_doubled_,
                                n_doubled_ == 1 ? " was" : "s were"));
  if (n_missing_ > 0)
    notes.push_back(fmt::format("{} sample{} no value; straight lines between the neighbours take {} place",
                                n_missing_, n_missing_ == 1 ? " has" : "s have",
                                n_missing_ == 1 ? "its" : "their"));
  return notes;
}

ForceRecord read_force(const std::string &path)
{
  const RawRecord raw          = read_record(path, options_of_case_record());
  const Eigen::VectorXd &force = raw.channels[force_channel(raw)].value;
  const DrivingSamples samples = samples_of(raw, force, force);
  ForceRecord record;
  record.time  = vector_of(samples.time);
  record.force = vector_of(samples.first);
  record.start = raw.start;
  record.notes = samples.notes;
  return record;
}

MeasuredRecord read_measured(const std::string &path)
{
  const RawRecord raw     = read_record(path, options_of_case_record());
  const RawChannel &upper = acceleration_channel(raw, "upper_work_roll");
  const RawChannel &lower = acceleration_channel(raw, "lower_work_roll");
  const auto samples      = samples_of(raw, upper.value, lower.value);
  MeasuredRecord record;
  record.time            = vector_of(samples.time);
  record.upper_work_roll = vector_of(samples.first);
  record.lower_work_roll = vector_of(samples.second);
  record.start           = raw.start;
  record.notes           = samples.notes;
  return record;
}
}  // namespace mill::twin
