#pragma once
#include "twin/live/compare/alarm_book.h"
#include "twin/live/compare/chatter_events.h"
#include "twin/live/page/event_text.h"
#include "twin/onset/onset_watch.h"
#include "twin/onset/running_envelopes.h"
#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace mill::live {
/// A band of +-20 Hz that is watched.
struct WatchedBand {
  std::string name;          ///< "third octave", "mode 6"
  double frequency = 0;      ///< Hz
  bool is_mode     = false;  ///< of the twin; else a part of a band of [monitoring]
};
/// Neighbouring bands that cover low .. high, 32 Hz apart.
std::vector<WatchedBand> bands_over(const std::string &name, double low, double high);

/// Baselines and growth rates of the bands, from which a restarted program continues.
struct StoredOnset {
  struct One {
    std::string channel;
    double frequency = 0;        ///< Hz, of the band
    double baseline  = unknown;  ///< m/s2, 0-peak
    twin::GrowthRate growth;
    int near = 0;  ///< growth rates in a row near zero, of the band
  };
  double utc = unknown;  ///< s since 1970, of the last value
  std::vector<One> all;
};

/// Onset of chatter in bands of the measured channels: alarms and growth rates of theory.md 41.5, second by
/// second, and the mill's own limit.
class OnsetMonitor {
public:
  /// @param places  names of the channels, for the sentences
  /// @param limit   m/s2, 0-peak: the mill's own
  OnsetMonitor(double rate, std::vector<std::string> places, std::vector<WatchedBand> bands,
               std::optional<double> limit);

  /// @param measured  (n, channels) m/s2; NaN: missing
  /// Alarms that begin, change or end go to the book.  Cost at 20 kHz, 4 channels, 6 bands: 4 ms per second.
  void take(std::int64_t first, double start_time, const Eigen::MatrixXd &measured, AlarmBook &book);
  void restart();

  StoredOnset stored() const;
  /// Baselines hold until the bands have their own, growth rates until there are as long ones.  Bands and channels
  /// that are not watched any more are left out.
  void resume(const StoredOnset &stored);
  /// Whether an alarm of this cause can still end: not where its band is not watched any more.
  bool knows(const std::string &cause) const;

  /// By band, of the channel that is highest above its baseline; growth of the one nearest to instability.
  std::vector<ChatterBand> bands() const;

private:
  struct Watched {
    twin::OnsetWatch watch;
    twin::GrowthRate growth;
    double kept = unknown;            // m/s2, baseline of before a gap
    std::complex<double> last, turn;  // envelope, and its turn from value to value over the last 0.2 s
  };
  void take_value(double time, double utc, const Eigen::MatrixXcd &z, AlarmBook &book);
  void carry_over(double utc);
  struct Onset {
    std::size_t band, channel;
    twin::Alarm alarm;
  };
  double frequency_seen(std::size_t band, std::size_t channel) const;  // Hz
  std::string nearest_mode(double frequency) const;                    // "; the nearest mode is .."
  std::string text_of(const Onset &onset, double frequency) const;
  void raise_onsets(std::vector<Onset> onsets, double utc, AlarmBook &book);
  void watch_limit(std::size_t band, double utc, AlarmBook &book);
  bool calm(std::size_t band) const;
  bool warned_by_neighbour(std::size_t band, double frequency, const AlarmBook &book) const;
  bool renew_rates(std::size_t band);
  void renew_growth(std::size_t band, double utc, AlarmBook &book);
  Watched &at(std::size_t band, std::size_t channel);
  const Watched &at(std::size_t band, std::size_t channel) const;

  std::vector<std::string> channels;
  std::vector<WatchedBand> watched;
  std::optional<double> limit;
  twin::RunningEnvelopes envelopes;
  std::vector<Watched> all;            // by band, then channel
  std::vector<int> near;               // growth rates in a row with their upper end near zero, by band
  std::vector<double> near_frequency;  // Hz, of the warning of each band
  std::vector<int> beyond;             // values in a row above the limit, by band
  ChatterEvents events;
  bool taken_over     = false;  // alarms of before a restart
  std::int64_t values = 0;
  double last         = unknown;  // s since 1970, of the last value
  bool after_gap      = false;
};
}  // namespace mill::live
