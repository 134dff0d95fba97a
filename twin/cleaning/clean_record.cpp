#include "twin/cleaning/clean_record.h"
#include "twin/cleaning/channel_faults.h"
#include "twin/cleaning/long_gaps.h"
#include "twin/cleaning/spline.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr Eigen::Index longest_filled = 2;  // samples
constexpr const char *cut_here        = "record cut here";

const char *filling_word(const bool uneven)
{
  return uneven ? "filled by the cubic spline" : "filled linearly";
}

// Rows that are not there, for all channels at once, in samples of the grid.
struct RowGap {
  Eigen::Index first, n;
};

double nan()
{
  return std::numeric_limits<double>::quiet_NaN();
}

// Runs of NaN: short ones between numbers are filled, all are listed but those of rows that are missing for all.
void fill_short_gaps(CleanChannel &channel, const double rate, const std::vector<RowGap> &of_all,
                     EventList &events)
{
  auto next            = of_all.begin();  // both lists are in the order of time
  const auto is_listed = [&](const Eigen::Index first, const Eigen::Index n) {
    next = std::find_if(next, of_all.end(), [&](const RowGap &gap) { return gap.first >= first; });
    return next != of_all.end() && next->n == n && next->first == first;
  };
  Eigen::VectorXd &x = channel.value;
  for (Eigen::Index i = 0; i < x.size();) {
    if (!std::isnan(x[i])) {
      ++i;
      continue;
    }
    Eigen::Index end = i;
    while (end < x.size() && std::isnan(x[end]))
      ++end;
    const Eigen::Index n = end - i;
    const bool fills     = n <= longest_filled && i > 0 && end < x.size();
    if (fills) {
      for (Eigen::Index k = i; k < end; ++k)
        x[k] = x[i - 1] + (x[end] - x[i - 1]) * double(k - i + 1) / double(n + 1);
      channel.filled += n;
    }
    if (!is_listed(i, n))
      events.push_back({channel.name, n > longest_filled ? CleaningFault::gap : CleaningFault::missing,
                        double(i) / rate, double(end - 1) / rate, n, fills ? filling_word(false) : cut_here});
    i = end;
  }
}

// Empty cells of a record that a spline puts onto its grid: those that it fills, and those where it ends.
void list_empty_cells(CleanChannel &channel, const Eigen::VectorXd &value, const Eigen::VectorXd &time,
                      const TimeGrid &grid, EventList &events)
{
  Eigen::Index before = -1;  // place of the last number
  for (Eigen::Index i = 0; i < value.size();) {
    if (!std::isnan(value[i])) {
      before = std::max(before, grid.position[std::size_t(i)]);
      ++i;
      continue;
    }
    Eigen::Index end = i, behind = -1;
    for (; end < value.size() && (std::isnan(value[end]) || grid.position[std::size_t(end)] < 0); ++end) {
    }
    if (end < value.size())
      behind = grid.position[std::size_t(end)];
    const bool fills     = before >= 0 && behind >= 0 && behind - before <= longest_filled + 1;
    const Eigen::Index n = value.segment(i, end - i).array().isNaN().count();
    channel.filled += fills ? n : 0;
    events.push_back({channel.name, fills ? CleaningFault::missing : CleaningFault::gap, time[i], time[end - 1], n,
                      fills ? filling_word(true) : cut_here});
    i = end;
  }
}

void find_pieces(CleanChannel &channel)
{
  const Eigen::VectorXd &x = channel.value;
  for (Eigen::Index i = 0; i < x.size();) {
    if (std::isnan(x[i])) {
      ++i;
      continue;
    }
    Eigen::Index end = i;
    while (end < x.size() && !std::isnan(x[end]))
      ++end;
    channel.pieces.push_back({i, end});
    i = end;
  }
}

// Values at their places on the grid; NaN where nothing was recorded.
Eigen::VectorXd placed(const Eigen::VectorXd &value, const TimeGrid &grid)
{
  Eigen::VectorXd on_grid = Eigen::VectorXd::Constant(grid.n, nan());
  for (Eigen::Index i = 0; i < value.size(); ++i)
    if (const Eigen::Index k = grid.position[std::size_t(i)]; k >= 0)
      on_grid[k] = value[i];
  return on_grid;
}

// The same by a cubic spline between long gaps, through the samples where they really stand.
Eigen::VectorXd interpolated(const Eigen::VectorXd &value, const Eigen::VectorXd &time, const TimeGrid &grid)
{
  Eigen::VectorXd on_grid = Eigen::VectorXd::Constant(grid.n, nan());
  std::vector<double> x, y;
  Eigen::Index first = 0, last = -1;
  const auto flush = [&] {
    if (x.size() >= 2) {
      const auto m = Eigen::Index(x.size()), n = last - first + 1;
      on_grid.segment(first, n) =
          spline_on_grid(Eigen::Map<const Eigen::VectorXd>(x.data(), m),
                         Eigen::Map<const Eigen::VectorXd>(y.data(), m), double(first), 1, n);
    }
    x.clear();
    y.clear();
  };
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    const Eigen::Index k = grid.position[std::size_t(i)];
    if (k < 0 || std::isnan(value[i]))
      continue;
    if (x.empty() || k - last > longest_filled + 1) {
      flush();
      first = k;
    }
    x.push_back((time[i] - grid.offset) * grid.rate);
    y.push_back(value[i]);
    last = k;
  }
  flush();
  return on_grid;
}

void add_listed(CleanRecord &record, const EventList &events, const std::string &name)
{
  const auto &listed = events.listed();
  if (events.size() > listed.size())
    record.notes.push_back(
        fmt::format("{}: {} faults were found, the first {} are listed", name, events.size(), listed.size()));
  record.events.insert(record.events.end(), listed.begin(), listed.end());
}

std::vector<RowGap> row_gaps(const TimeGrid &grid)
{
  std::vector<RowGap> gaps;
  Eigen::Index before = 0;
  for (const Eigen::Index k : grid.position) {
    if (k > before + 1)
      gaps.push_back({before + 1, k - before - 1});
    before = std::max(before, k);
  }
  return gaps;
}

void list_row_gaps(CleanRecord &record, const std::vector<RowGap> &gaps, const TimeGrid &grid)
{
  EventList events;
  for (const RowGap &gap : gaps)
    events.push_back({"", CleaningFault::gap, double(gap.first) / grid.rate,
                      double(gap.first + gap.n - 1) / grid.rate, gap.n,
                      gap.n <= longest_filled ? filling_word(grid.uneven) : cut_here});
  add_listed(record, events, "rows");
}

CleanChannel clean_channel(RawChannel &&raw, const RawRecord &record, const TimeGrid &grid,
                           const std::vector<RowGap> &of_all, EventList &events)
{
  CleanChannel channel;
  channel.name              = raw.name;
  channel.column            = raw.column;
  channel.unit              = raw.unit;
  channel.quantity          = raw.quantity;
  channel.missing           = raw.value.array().isNaN().count();
  const bool steady_allowed = raw.quantity == Quantity::speed;  // a mill that runs at one speed is not a fault
  if (!steady_allowed)
    find_clipping(channel, raw.value, grid.rate, events);
  if (grid.position.empty())
    channel.value = std::move(raw.value);
  else if (!grid.uneven)
    channel.value = placed(raw.value, grid);
  else {
    list_empty_cells(channel, raw.value, record.time, grid, events);
    channel.value = interpolated(raw.value, record.time, grid);
  }
  raw.value.resize(0);
  if (!grid.uneven && channel.value.array().isNaN().any())
    fill_short_gaps(channel, grid.rate, of_all, events);
  find_pieces(channel);
  if (!steady_allowed) {
    cut_stuck(channel, grid.rate, events);
    take_off_drift(channel, grid.rate);
  }
  return channel;
}

void add_labels(CleanRecord &record, const RawRecord &raw)
{
  const auto time_of = [&](const Eigen::Index i) {
    return raw.time.size() > 0 ? raw.time[i] : double(i) / record.rate;
  };
  for (const LabelSpan &span : raw.labels)
    record.labels.push_back({span.column, span.text, time_of(span.begin), time_of(span.end - 1)});
}

// Counters, ramps, constants and set values leave the channels and are said in a sentence.
void describe_channels(CleanRecord &record, RawRecord &raw)
{
  std::vector<RawChannel> kept;
  for (RawChannel &channel : raw.channels)
    if (auto description = described(channel)) {
      record.notes.push_back(
          fmt::format("{}: {}; described and not analysed", channel.name, description->sentence));
      record.described.push_back(std::move(*description));
    } else
      kept.push_back(std::move(channel));
  raw.channels = std::move(kept);
}

std::string list_of(const std::vector<DescribedChannel> &channels)
{
  std::string text;
  for (const DescribedChannel &channel : channels)
    text += fmt::format("{}{}: {}", text.empty() ? " (" : "; ", channel.name, channel.sentence);
  return text.empty() ? "" : text + ")";
}
}  // namespace

Eigen::Index CleanChannel::n_used() const
{
  Eigen::Index n = 0;
  for (const Span &piece : pieces)
    n += piece.size();
  return n;
}

const CleanChannel *CleanRecord::find(const std::string &name) const
{
  for (const CleanChannel &channel : channels)
    if (channel.name == name)
      return &channel;
  return nullptr;
}

double CleanRecord::duration() const
{
  return double(n) / rate;
}

CleanRecord clean_record(RawRecord &&raw)
{
  shorten_long_gaps(raw);
  const TimeGrid grid = time_grid(raw);
  CleanRecord record;
  record.file                      = raw.file;
  record.format                    = raw.format;
  record.rate                      = grid.rate;
  record.jitter                    = grid.jitter;
  record.interpolated              = grid.uneven;
  record.n                         = grid.n;
  record.start                     = raw.start;
  record.notes                     = raw.notes;
  const std::vector<RowGap> of_all = row_gaps(grid);
  list_row_gaps(record, of_all, grid);
  if (grid.doubled > 0)
    record.events.push_back({"", CleaningFault::doubled, 0, double(grid.n - 1) / grid.rate, grid.doubled,
                             "samples with the time of their neighbour were left out"});
  if (grid.uneven)
    record.events.push_back(
        {"", CleaningFault::jitter, 0, double(grid.n - 1) / grid.rate, raw.n_samples(),
         fmt::format("times are {:.3g} samples (rms) away from an even grid; put onto it by a cubic spline",
                     grid.jitter * grid.rate)});
  add_labels(record, raw);
  const Place first_place = raw.channels.front().place;
  describe_channels(record, raw);
  for (RawChannel &channel : raw.channels) {
    EventList events;
    const std::string name = channel.name;
    const Place place      = channel.place;
    record.channels.push_back(clean_channel(std::move(channel), raw, grid, of_all, events));
    add_listed(record, events, name);
  }
  const bool any = std::any_of(record.channels.begin(), record.channels.end(), [](const CleanChannel &c) {
    return c.quantity != Quantity::speed && c.n_used() > 0;
  });
  if (!any)
    throw InputError(first_place, "every channel stands still or is empty" + list_of(record.described) +
                                      "; check cables and amplifiers, or choose another record");
  return record;
}
}  // namespace mill::twin
