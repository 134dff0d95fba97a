#include "live/compare/onset_monitor.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr double least_kept  = 0.3;  // correlation left at the second lag, theory.md 41.5
constexpr int growth_every   = 10;   // s, of a band
constexpr int times_near     = 2;    // growth rates in a row before it is a warning
constexpr double least_time  = 30;   // s, of record behind a growth rate that warns
constexpr double calm_again  = 0.2;  // 1/s, below the limit of the warning
constexpr double warned_from = -0.5;

Eigen::VectorXd frequencies_of(const std::vector<WatchedBand> &bands)
{
  Eigen::VectorXd f(Eigen::Index(bands.size()));
  for (std::size_t i = 0; i < bands.size(); ++i)
    f[Eigen::Index(i)] = bands[i].frequency;
  return f;
}

std::vector<WatchedBand> below_nyquist(std::vector<WatchedBand> bands, const double rate)
{
  bands.erase(std::remove_if(bands.begin(), bands.end(),
                             [&](const WatchedBand &b) { return !(2.56 * b.frequency < rate); }),
              bands.end());
  return bands;
}
}  // namespace

std::vector<WatchedBand> bands_over(const std::string &name, const double low, const double high)
{
  constexpr double apart = 32;  // Hz: bands of +-20 Hz overlap where the filter falls off
  const int n            = std::max(1, int(std::ceil((high - low - 8) / apart)));
  std::vector<WatchedBand> bands;
  for (int i = 0; i < n; ++i)
    bands.push_back({name, low + (high - low) * (i + 0.5) / n});
  return bands;
}

OnsetMonitor::OnsetMonitor(const double rate, std::vector<std::string> places, std::vector<WatchedBand> bands,
                           const std::optional<double> limit_)
    : channels(std::move(places)), watched(below_nyquist(std::move(bands), rate)), limit(limit_),
      envelopes(rate, Eigen::Index(channels.size()), frequencies_of(watched)), near(watched.size(), 0)
{
  twin::AlarmSettings rule;
  rule.limit = limit;
  for (const WatchedBand &band : watched)
    for (std::size_t c = 0; c < channels.size(); ++c)
      all.push_back({twin::OnsetWatch(band.frequency, envelopes.rate(), rule), {}});
}

OnsetMonitor::Watched &OnsetMonitor::at(const std::size_t band, const std::size_t channel)
{
  return all[band * channels.size() + channel];
}

const OnsetMonitor::Watched &OnsetMonitor::at(const std::size_t band, const std::size_t channel) const
{
  return all[band * channels.size() + channel];
}

void OnsetMonitor::restart()
{
  envelopes.restart();
  for (Watched &one : all) {
    one.watch.restart();
    one.growth = {};
  }
  std::fill(near.begin(), near.end(), 0);
}

void OnsetMonitor::take(const std::int64_t first, const double start_time, const Eigen::MatrixXd &measured,
                        AlarmBook &book)
{
  envelopes.take(first, measured, [&](const double time, const Eigen::MatrixXcd &z) {
    take_value(time, start_time + time, z, book);
  });
}

void OnsetMonitor::take_value(const double time, const double utc, const Eigen::MatrixXcd &z, AlarmBook &book)
{
  for (std::size_t b = 0; b < watched.size(); ++b) {
    bool above              = false;
    const std::string cause = fmt::format("chatter {:.6g}", watched[b].frequency);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Watched &one = at(b, c);
      if (const auto alarm = one.watch.take(time, z(Eigen::Index(b), Eigen::Index(c)))) {
        std::string text = fmt::format(
            "{} at {:.1f} Hz, {}: {:.3g} m/s2 is {:.1f} times the level while it was calm", watched[b].name,
            watched[b].frequency, channels[c], alarm->level, alarm->level / alarm->baseline);
        text += alarm->sigma > 0 ? fmt::format(", growing at {:.1f} 1/s", alarm->sigma) : ", not growing";
        if (std::isfinite(alarm->to_limit))
          text += fmt::format("; the limit of {:.3g} m/s2 in {:.2f} s", *limit, alarm->to_limit);
        if (!book.open(cause))
          book.raise(cause, utc, "chatter", "alarm", text);
      }
      above = above || one.watch.above_half_threshold();
    }
    if (!above)
      book.end(cause);
  }
  // growth rates of one band after the other, all of them once in ten seconds
  const auto per_round = std::int64_t(std::lround(growth_every * envelopes.rate()));
  for (std::size_t b = 0; b < watched.size(); ++b)
    if (values % per_round == std::int64_t(b) * per_round / std::int64_t(watched.size()))
      renew_growth(b, utc, book);
  ++values;
}

void OnsetMonitor::renew_growth(const std::size_t band, const double utc, AlarmBook &book)
{
  double highest       = -std::numeric_limits<double>::infinity();
  std::size_t at_place = 0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    Watched &one = at(band, c);
    one.growth   = one.watch.growth();
    if (one.growth.kept >= least_kept && one.growth.duration >= least_time && one.growth.upper() > highest) {
      highest  = one.growth.upper();
      at_place = c;
    }
  }
  const std::string cause = fmt::format("near instability {:.6g}", watched[band].frequency);
  near[band]              = highest > warned_from ? near[band] + 1 : 0;
  if (near[band] >= times_near) {
    const twin::GrowthRate &growth = at(band, at_place).growth;
    book.raise(cause, utc, "chatter", "warning",
               fmt::format("{} at {:.1f} Hz, {}: growth rate {:.2f} 1/s, 95 % below {:.2f} 1/s, over {:.0f} s; "
                           "above {:.1f} 1/s the stand is near instability",
                           watched[band].name, growth.frequency, channels[at_place], growth.sigma, growth.upper(),
                           growth.duration, warned_from));
  } else if (highest < warned_from - calm_again)
    book.end(cause);
}

std::vector<ChatterBand> OnsetMonitor::bands() const
{
  std::vector<ChatterBand> bands;
  for (std::size_t b = 0; b < watched.size(); ++b) {
    ChatterBand band{watched[b].name, watched[b].frequency};
    band.state   = "unknown";
    double ratio = -1;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Watched &one = at(b, c);
      const double here  = one.watch.level() / one.watch.baseline();
      if (here > ratio) {
        ratio          = here;
        band.amplitude = one.watch.level();
        band.baseline  = one.watch.baseline();
      }
      if (one.growth.kept >= least_kept && !(one.growth.upper() <= band.growth_high)) {
        band.growth      = one.growth.sigma;
        band.growth_high = one.growth.upper();
      }
    }
    if (ratio >= 0)
      band.state = ratio > 5 ? "alarm" : near[b] >= times_near ? "warning" : "calm";
    bands.push_back(band);
  }
  return bands;
}
}  // namespace mill::live
