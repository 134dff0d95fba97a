#include "twin/live/compare/onset_monitor.h"
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
constexpr double carried_for = 60;   // s, of a gap over which a baseline still says what calm is
constexpr int times_beyond   = 2;    // values in a row above the limit, as for the rise above a baseline
constexpr double below_again = 0.8;  // -, of the limit

std::string onset_cause(const double frequency)
{
  return fmt::format("chatter {:.6g}", frequency);
}

std::string near_cause(const double frequency)
{
  return fmt::format("near instability {:.6g}", frequency);
}

std::string limit_cause(const double frequency)
{
  return fmt::format("limit {:.6g}", frequency);
}

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
      envelopes(rate, Eigen::Index(channels.size()), frequencies_of(watched)), near(watched.size(), 0),
      beyond(watched.size(), 0)
{
  twin::AlarmSettings rule;
  rule.limit = limit;
  for (const WatchedBand &band : watched)
    for (std::size_t c = 0; c < channels.size(); ++c)
      all.push_back({twin::OnsetWatch(band.frequency, envelopes.rate(), rule), {}, unknown});
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
    if (const double baseline = one.watch.baseline(); std::isfinite(baseline))
      one.kept = baseline;
    one.watch.restart();
  }
  after_gap = true;
}

// What was calm a minute ago is so still; later another strip may be in the mill.
void OnsetMonitor::carry_over(const double utc)
{
  after_gap = false;
  if (std::abs(utc - last) <= carried_for) {
    for (Watched &one : all)
      if (std::isfinite(one.kept))
        one.watch.carry(one.kept);
    return;
  }
  for (Watched &one : all) {
    one.growth = {};
    one.kept   = unknown;
  }
  std::fill(near.begin(), near.end(), 0);
}

StoredOnset OnsetMonitor::stored() const
{
  StoredOnset now;
  now.utc = last;
  for (std::size_t b = 0; b < watched.size(); ++b)
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Watched &one    = at(b, c);
      const double baseline = one.watch.baseline();
      now.all.push_back(
          {channels[c], watched[b].frequency, std::isfinite(baseline) ? baseline : one.kept, one.growth, near[b]});
    }
  return now;
}

void OnsetMonitor::resume(const StoredOnset &stored)
{
  constexpr double same_band = 1e-6;  // -, of its frequency
  last                       = stored.utc;
  after_gap                  = true;
  for (const StoredOnset::One &before : stored.all)
    for (std::size_t b = 0; b < watched.size(); ++b)
      for (std::size_t c = 0; c < channels.size(); ++c)
        if (channels[c] == before.channel && std::abs(before.frequency / watched[b].frequency - 1) < same_band) {
          at(b, c).kept   = before.baseline;
          at(b, c).growth = before.growth;
          near[b]         = before.near;
        }
}

bool OnsetMonitor::knows(const std::string &cause) const
{
  return std::any_of(watched.begin(), watched.end(), [&](const WatchedBand &band) {
    return cause == onset_cause(band.frequency) || cause == near_cause(band.frequency) ||
           (limit && cause == limit_cause(band.frequency));
  });
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
  if (after_gap)
    carry_over(utc);
  last = utc;
  for (std::size_t b = 0; b < watched.size(); ++b) {
    bool above = false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Watched &one = at(b, c);
      if (const auto alarm = one.watch.take(time, z(Eigen::Index(b), Eigen::Index(c))))
        raise_onset(b, c, *alarm, utc, book);
      above = above || one.watch.above_half_threshold();
    }
    if (!above)
      book.end(onset_cause(watched[b].frequency));
    if (limit)
      watch_limit(b, utc, book);
  }
  // growth rates of one band after the other, all of them once in ten seconds
  const auto per_round = std::int64_t(std::lround(growth_every * envelopes.rate()));
  for (std::size_t b = 0; b < watched.size(); ++b)
    if (values % per_round == std::int64_t(b) * per_round / std::int64_t(watched.size()))
      renew_growth(b, utc, book);
  ++values;
}

void OnsetMonitor::raise_onset(const std::size_t band, const std::size_t channel, const twin::Alarm &alarm,
                               const double utc, AlarmBook &book)
{
  const std::string cause = onset_cause(watched[band].frequency);
  if (book.open(cause))
    return;
  std::string text = fmt::format("{} at {:.1f} Hz, {}: {:.3g} m/s2 is {:.1f} times the level while it was calm",
                                 watched[band].name, watched[band].frequency, channels[channel], alarm.level,
                                 alarm.level / alarm.baseline);
  text += alarm.sigma > 0 ? fmt::format(", growing at {:.1f} 1/s", alarm.sigma) : ", not growing";
  if (std::isfinite(alarm.to_limit)) {
    const double threshold = twin::AlarmSettings{}.threshold * alarm.baseline;
    text += fmt::format("; the limit of {:.3g} m/s2 in {:.2f} s", *limit, alarm.to_limit);
    if (threshold < *limit)
      text += fmt::format(" (at this growth no alarm leads it by more than {:.2f} s)",
                          twin::longest_lead(*limit, threshold, alarm.sigma));
  }
  book.raise(cause, utc, "chatter", "alarm", text);
}

// The level that the mill itself has set: no baseline is needed, and what was loud from the start is told too.
void OnsetMonitor::watch_limit(const std::size_t band, const double utc, AlarmBook &book)
{
  double highest      = -1;
  std::size_t loudest = 0;
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (const double level = at(band, c).watch.level(); level > highest) {
      highest = level;
      loudest = c;
    }
  const std::string cause = limit_cause(watched[band].frequency);
  beyond[band]            = highest > *limit ? beyond[band] + 1 : 0;
  if (beyond[band] >= times_beyond && !book.open(cause))
    book.raise(
        cause, utc, "chatter", "alarm",
        fmt::format("{} at {:.1f} Hz, {}: {:.3g} m/s2 is above the limit of {:.3g} m/s2 that is set for this "
                    "mill",
                    watched[band].name, watched[band].frequency, channels[loudest], highest, *limit));
  else if (highest >= 0 && highest < below_again * *limit)
    book.end(cause);
}

// False: behind a gap or a restart there is not enough record yet, and the rates of before stand.
bool OnsetMonitor::renew_rates(const std::size_t band)
{
  bool fresh = false;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    Watched &one                 = at(band, c);
    const twin::GrowthRate found = one.watch.growth();
    if (found.duration >= least_time || !(one.growth.duration >= least_time))
      one.growth = found;
    fresh = fresh || found.duration >= least_time;
  }
  return fresh;
}

void OnsetMonitor::renew_growth(const std::size_t band, const double utc, AlarmBook &book)
{
  if (!renew_rates(band))
    return;
  double highest       = -std::numeric_limits<double>::infinity();
  std::size_t at_place = 0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const twin::GrowthRate &growth = at(band, c).growth;
    if (growth.kept >= least_kept && growth.duration >= least_time && growth.upper() > highest) {
      highest  = growth.upper();
      at_place = c;
    }
  }
  const std::string cause = near_cause(watched[band].frequency);
  near[band]              = highest > twin::near_instability_from ? near[band] + 1 : 0;
  if (near[band] >= times_near) {
    const twin::GrowthRate &growth = at(band, at_place).growth;
    book.raise(cause, utc, "chatter", "warning",
               fmt::format("{} at {:.1f} Hz, {}: growth rate {:.2f} 1/s, 95 % below {:.2f} 1/s, over {:.0f} s; "
                           "above {:.1f} 1/s the stand is near instability",
                           watched[band].name, growth.frequency, channels[at_place], growth.sigma, growth.upper(),
                           growth.duration, twin::near_instability_from));
  } else if (highest < twin::near_instability_from - calm_again)
    book.end(cause);
}

std::vector<ChatterBand> OnsetMonitor::bands() const
{
  std::vector<ChatterBand> bands;
  for (std::size_t b = 0; b < watched.size(); ++b) {
    ChatterBand band;
    band.name      = watched[b].name;
    band.frequency = watched[b].frequency;
    band.state     = "unknown";
    double ratio   = -1;
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
      band.state = ratio > 5 || beyond[b] >= times_beyond ? "alarm" : near[b] >= times_near ? "warning" : "calm";
    bands.push_back(band);
  }
  return bands;
}
}  // namespace mill::live
