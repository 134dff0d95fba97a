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
constexpr double turn_memory = 0.1;  // -, share of the newest value: 0.2 s at 50 values a second

std::string near_cause(const double frequency)
{
  return fmt::format("near instability {:.6g}", frequency);
}

Eigen::VectorXd frequencies_of(const std::vector<WatchedBand> &bands)
{
  Eigen::VectorXd f(Eigen::Index(bands.size()));
  for (std::size_t i = 0; i < bands.size(); ++i)
    f[Eigen::Index(i)] = bands[i].frequency;
  return f;
}

std::vector<double> listed(const Eigen::VectorXd &values)
{
  return {values.begin(), values.end()};
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
      near_frequency(watched.size(), unknown), beyond(watched.size(), 0), events(listed(frequencies_of(watched)))
{
  twin::AlarmSettings rule;
  rule.limit = limit;
  for (const WatchedBand &band : watched)
    for (std::size_t c = 0; c < channels.size(); ++c)
      all.push_back({twin::OnsetWatch(band.frequency, envelopes.rate(), rule), {}, unknown, {}, {}});
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

// A baseline of a minute ago still holds; later another strip may be in the mill.
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
  return events.knows(cause) || std::any_of(watched.begin(), watched.end(), [&](const WatchedBand &band) {
           return cause == near_cause(band.frequency);
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
  if (!taken_over)
    events.take_over(book);
  taken_over = true;
  std::vector<Onset> onsets;
  for (std::size_t b = 0; b < watched.size(); ++b)
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Watched &one                 = at(b, c);
      const std::complex<double> x = z(Eigen::Index(b), Eigen::Index(c));
      if (const auto alarm = one.watch.take(time, x))
        onsets.push_back({b, c, *alarm});
      const std::complex<double> turn = x * std::conj(one.last);
      one.turn = std::isfinite(std::norm(turn)) ? (1 - turn_memory) * one.turn + turn : std::complex<double>{};
      one.last = x;
    }
  raise_onsets(std::move(onsets), utc, book);
  for (std::size_t b = 0; limit && b < watched.size(); ++b)
    watch_limit(b, utc, book);
  events.end_calm([&](const std::size_t b) { return calm(b); }, book);
  // growth rates of one band after the other, all of them once in ten seconds
  const auto per_round = std::int64_t(std::lround(growth_every * envelopes.rate()));
  for (std::size_t b = 0; b < watched.size(); ++b)
    if (values % per_round == std::int64_t(b) * per_round / std::int64_t(watched.size()))
      renew_growth(b, utc, book);
  ++values;
}

// The envelope turns by the difference between the frequency of the vibration and that of the band.
double OnsetMonitor::frequency_seen(const std::size_t band, const std::size_t channel) const
{
  const std::complex<double> turn = at(band, channel).turn;
  const double off                = std::norm(turn) > 0 ? std::arg(turn) * envelopes.rate() / (2 * M_PI) : 0;
  return watched[band].frequency + off;
}

std::string OnsetMonitor::nearest_mode(const double frequency) const
{
  const WatchedBand *nearest = nullptr;
  for (const WatchedBand &band : watched)
    if (band.is_mode && (!nearest || std::abs(std::log(band.frequency / frequency)) <
                                         std::abs(std::log(nearest->frequency / frequency))))
      nearest = &band;
  return nearest
             ? fmt::format("; the nearest mode of the twin is {} at {:.1f} Hz", nearest->name, nearest->frequency)
             : "";
}

std::string OnsetMonitor::text_of(const Onset &onset, const double frequency) const
{
  const twin::Alarm &alarm = onset.alarm;
  std::string text         = fmt::format(", {}: {:.3g} m/s2 is {:.1f} times the level while it was calm",
                                         channels[onset.channel], alarm.level, alarm.level / alarm.baseline);
  text += alarm.sigma > 0 ? fmt::format(", growing at {:.1f} 1/s", alarm.sigma) : ", not growing";
  if (std::isfinite(alarm.to_limit)) {
    const double threshold = twin::AlarmSettings{}.threshold * alarm.baseline;
    text += fmt::format("; the limit of {:.3g} m/s2 in {:.2f} s", *limit, alarm.to_limit);
    if (threshold < *limit)
      text += fmt::format(" (at this growth no alarm leads it by more than {:.2f} s)",
                          twin::longest_lead(*limit, threshold, alarm.sigma));
  }
  return text + nearest_mode(frequency);
}

// The loudest first: what is weaker in other bands joins its alarm.
void OnsetMonitor::raise_onsets(std::vector<Onset> onsets, const double utc, AlarmBook &book)
{
  std::stable_sort(onsets.begin(), onsets.end(),
                   [](const Onset &a, const Onset &b) { return a.alarm.level > b.alarm.level; });
  for (const Onset &onset : onsets) {
    const double frequency = frequency_seen(onset.band, onset.channel);
    events.rise(
        {onset.band, frequency, onset.alarm.level, utc, text_of(onset, frequency)},
        [&](const std::size_t band) { return at(band, onset.channel).watch.level(); }, book);
  }
}

// The level that the mill itself has set: it needs no baseline, so that a mill that was loud from the start has an
// alarm too.
void OnsetMonitor::watch_limit(const std::size_t band, const double utc, AlarmBook &book)
{
  double highest      = -1;
  std::size_t loudest = 0;
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (const double level = at(band, c).watch.level(); level > highest) {
      highest = level;
      loudest = c;
    }
  beyond[band] = highest > *limit ? beyond[band] + 1 : 0;
  if (beyond[band] < times_beyond)
    return;
  const double frequency = frequency_seen(band, loudest);
  const std::string sentence =
      fmt::format("{:.3g} m/s2 is above the limit of {:.3g} m/s2 that is set for this mill", highest, *limit);
  events.beyond_limit(
      {band, frequency, highest, utc,
       fmt::format(", {}: {}{}", channels[loudest], sentence, nearest_mode(frequency))},
      sentence, [&](const std::size_t b) { return at(b, loudest).watch.level(); }, book);
}

// Below half of the threshold, and clearly below the limit, in all channels.
bool OnsetMonitor::calm(const std::size_t band) const
{
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const twin::OnsetWatch &watch = at(band, c).watch;
    if (watch.above_half_threshold() || (limit && !(watch.level() < below_again * *limit)))
      return false;
  }
  return true;
}

// False: after a gap or a restart there is not enough record yet, and the earlier rates stay.
bool OnsetMonitor::renew_rates(const std::size_t band)
{
  bool fresh = false;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    Watched &one                = at(band, c);
    const twin::GrowthRate rate = one.watch.growth();
    if (rate.duration >= least_time || !(one.growth.duration >= least_time))
      one.growth = rate;
    fresh = fresh || rate.duration >= least_time;
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
    if (warned_by_neighbour(band, growth.frequency, book))
      return;
    near_frequency[band] = growth.frequency;
    book.raise(cause, utc, "chatter", "warning",
               fmt::format("{} at {:.1f} Hz, {}: growth rate {:.2f} 1/s, 95 % below {:.2f} 1/s, over {:.0f} s; "
                           "above {:.1f} 1/s the stand is near instability",
                           watched[band].name, growth.frequency, channels[at_place], growth.sigma, growth.upper(),
                           growth.duration, twin::near_instability_from));
  } else if (highest < twin::near_instability_from - calm_again)
    book.end(cause);
}

// A mode between two bands is seen by both: one warning is enough.
bool OnsetMonitor::warned_by_neighbour(const std::size_t band, const double frequency, const AlarmBook &book) const
{
  constexpr double one_mode = 5;  // Hz
  for (std::size_t other = 0; other < watched.size(); ++other)
    if (other != band && std::abs(near_frequency[other] - frequency) < one_mode &&
        book.open(near_cause(watched[other].frequency)))
      return true;
  return false;
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
