#include "twin/live/display/page_feed.h"
#include "core/base/si_unit.h"
#include "twin/live/steady_clock.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <cmath>

namespace mill::live {
namespace {
constexpr double numbers_every = 0.05;  // s
constexpr double waits         = 1;     // s without samples: waiting

double rms(const std::vector<double> &values)
{
  double sum = 0;
  for (const double value : values)
    sum += value * value;
  return values.empty() ? unknown : std::sqrt(sum / double(values.size()));
}
}  // namespace

void PageFeed::begin(const LiveSource &source)
{
  source_     = source;
  speed_      = -1;
  last_speed_ = unknown;
  channel_of_place_.assign(source.places.size(), -1);
  for (std::size_t c = 0; c < source.channels.size(); ++c) {
    const auto place = std::find(source.places.begin(), source.places.end(), source.channels[c].name);
    if (place != source.places.end() && is_in(source.channels[c].unit, SiUnit::acceleration))
      channel_of_place_[std::size_t(place - source.places.begin())] = Eigen::Index(c);
    if (source.channels[c].name == word_of(twin::KnownChannel::speed))
      speed_ = Eigen::Index(c);
  }
  measured_.assign(source.places.size(), {});
  simulated_.assign(source.places.size(), {});
  n_ = 0;
}

void PageFeed::take(const LiveBlock &block)
{
  if (!source_)
    return;
  const auto append = [](std::vector<double> &to, const auto &column) {
    to.insert(to.end(), column.begin(), column.end());
  };
  for (std::size_t p = 0; p < simulated_.size(); ++p) {
    append(simulated_[p], block.simulated.col(Eigen::Index(p)));
    if (channel_of_place_[p] >= 0)
      append(measured_[p], block.measured.col(channel_of_place_[p]));
  }
  if (speed_ >= 0 && std::isfinite(block.measured(block.measured.rows() - 1, speed_)))
    last_speed_ = block.measured(block.measured.rows() - 1, speed_);
  n_ += block.force.size();
  force_ += block.force.sum();
  end_      = block.first + block.force.size();
  arrived_  = steady_now();
  gap_      = gap_ || block.after_gap;
  settling_ = block.settling;
  displacement_.assign(block.displacement.begin(), block.displacement.end());
}

std::optional<PageNumbers> PageFeed::numbers(const double now)
{
  if (!source_ || now - sent_ < numbers_every)
    return {};
  if (n_ == 0 && (said_waiting_ || now - arrived_ < waits))
    return {};
  PageNumbers numbers;
  numbers.s     = end_ - 1;
  numbers.utc   = source_->start_time + double(end_ - 1) / source_->rate;
  numbers.state = n_ == 0 ? "waiting" : gap_ ? "gap" : settling_ ? "settling" : "running";
  numbers.speed = last_speed_;
  if (n_ > 0) {
    numbers.force   = force_ / double(n_);
    numbers.latency = now - arrived_;
  }
  numbers.displacement = displacement_;
  for (std::size_t p = 0; p < simulated_.size(); ++p) {
    numbers.acceleration.push_back(rms(simulated_[p]));
    numbers.simulated.push_back(trace(simulated_[p].data(), std::int64_t(simulated_[p].size())));
    numbers.measured.push_back(trace(measured_[p].data(), std::int64_t(measured_[p].size())));
    simulated_[p].clear();
    measured_[p].clear();
  }
  said_waiting_ = n_ == 0;
  // Blocks come every 20 ms: what one event was late, the next is not.
  sent_  = now - sent_ < 2 * numbers_every ? sent_ + numbers_every : now;
  n_     = 0;
  force_ = 0;
  gap_   = false;
  return numbers;
}

PageMotion PageFeed::motion(const std::int64_t first, const double step, const Eigen::MatrixXd &motion) const
{
  PageMotion piece;
  piece.utc  = source_ ? source_->start_time + double(first) / source_->rate : 0;
  piece.step = step;
  for (const auto &row : motion.rowwise()) {
    piece.displacement.emplace_back();
    for (const double value : row)
      piece.displacement.back().push_back(float(value));
  }
  return piece;
}
}  // namespace mill::live
