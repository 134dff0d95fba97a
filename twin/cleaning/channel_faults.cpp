#include "twin/cleaning/channel_faults.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double same_level         = 1e-6;  // of the range
constexpr int neighbours_held       = 3;     // samples
constexpr double share_held         = 1e-3;  // of the samples
constexpr double shortest_stuck     = 5e-3;  // s
constexpr Eigen::Index fewest_stuck = 50;    // samples

struct HeldLevel {
  Eigen::Index count = 0, longest = 0;
};

template <class AtLevel> HeldLevel held(const Eigen::VectorXd &value, const AtLevel &at_level)
{
  HeldLevel level;
  Eigen::Index run = 0;
  for (const double x : value) {
    run = at_level(x) ? run + 1 : 0;
    level.count += run > 0;
    level.longest = std::max(level.longest, run);
  }
  return level;
}

template <class AtLevel>
void list_clips(const CleanChannel &channel, const Eigen::VectorXd &value, const double rate,
                const AtLevel &at_level, EventList &events)
{
  // neighbouring clips within 0.1 s are one entry of the list
  const auto apart = Eigen::Index(0.1 * rate);
  CleaningEvent open{channel.name, CleaningFault::clipped, 0, 0, 0, "counted; the peak is a lower bound"};
  Eigen::Index last = -apart - 1;
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    if (!at_level(value[i]))
      continue;
    if (i - last > apart) {
      if (open.count > 0)
        events.push_back(open);
      open.count = 0;
      open.from  = double(i) / rate;
    }
    ++open.count;
    open.to = double(i) / rate;
    last    = i;
  }
  if (open.count > 0)
    events.push_back(open);
}
}  // namespace

void find_clipping(CleanChannel &channel, const Eigen::VectorXd &value, const double rate, EventList &events)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  Eigen::Index n = 0;
  for (const double x : value)
    if (!std::isnan(x)) {
      low  = std::min(low, x);
      high = std::max(high, x);
      ++n;
    }
  const double range = high - low;
  if (n == 0 || !(range > 0))
    return;
  const auto above    = [&](const double x) { return x >= high - same_level * range; };
  const auto below    = [&](const double x) { return x <= low + same_level * range; };
  const auto is_level = [&](const HeldLevel &h) {
    return h.longest >= neighbours_held || (h.count > 1 && double(h.count) > share_held * double(n));
  };
  const HeldLevel top = held(value, above), bottom = held(value, below);
  if (is_level(top))
    channel.clip_high = high;
  if (is_level(bottom))
    channel.clip_low = low;
  const bool at_top = is_level(top), at_bottom = is_level(bottom);
  channel.clipped       = (at_top ? top.count : 0) + (at_bottom ? bottom.count : 0);
  channel.clipped_share = double(channel.clipped) / double(n);
  if (channel.clipped > 0)
    list_clips(
        channel, value, rate, [&](const double x) { return (at_top && above(x)) || (at_bottom && below(x)); },
        events);
}

void cut_stuck(CleanChannel &channel, const double rate, EventList &events)
{
  const Eigen::Index shortest = std::max(fewest_stuck, Eigen::Index(std::ceil(shortest_stuck * rate)));
  std::vector<Span> kept;
  for (const Span &piece : channel.pieces) {
    Eigen::Index begin = piece.begin;
    for (Eigen::Index i = piece.begin; i < piece.end;) {
      Eigen::Index end = i + 1;
      while (end < piece.end && channel.value[end] == channel.value[i])
        ++end;
      const double level = channel.value[i];
      if (end - i >= shortest && level != channel.clip_low && level != channel.clip_high) {
        if (i > begin)
          kept.push_back({begin, i});
        events.push_back({channel.name, CleaningFault::stuck, double(i) / rate, double(end - 1) / rate, end - i,
                          "piece removed"});
        channel.stuck += end - i;
        begin = end;
      }
      i = end;
    }
    if (begin < piece.end)
      kept.push_back({begin, piece.end});
  }
  channel.pieces = std::move(kept);
}

void take_off_drift(CleanChannel &channel, const double rate)
{
  double n = 0, mean_t = 0, mean = 0, tt = 0, tx = 0;
  for (const Span &piece : channel.pieces)
    for (Eigen::Index i = piece.begin; i < piece.end; ++i) {
      n += 1;
      const double t = double(i) / rate, dt = t - mean_t, dx = channel.value[i] - mean;
      mean_t += dt / n;
      mean += dx / n;
      tt += dt * (t - mean_t);
      tx += dt * (channel.value[i] - mean);
    }
  if (n < 2)
    return;
  channel.offset = mean;
  channel.drift  = tt > 0 ? tx / tt : 0;
  for (const Span &piece : channel.pieces)
    for (Eigen::Index i = piece.begin; i < piece.end; ++i)
      channel.value[i] -= mean + channel.drift * (double(i) / rate - mean_t);
}
}  // namespace mill::twin
