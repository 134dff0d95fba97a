#pragma once
#include "twin/comparison/running_comparison.h"
#include "twin/live/compare/alarm_book.h"
#include "twin/live/compare/chatter_watch.h"
#include "twin/live/compare/low_priority_task.h"
#include "twin/live/compare/mode_tracker.h"
#include "twin/live/compare/onset_monitor.h"
#include "twin/live/compare/proposals.h"
#include "twin/live/live_block.h"
#include "twin/live/page/event_text.h"
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mill::live {
/// What the comparison has to know of source, twin and stand.
struct ComparisonSetup {
  double rate = 0;                      ///< Hz
  std::vector<LiveChannel> channels;    ///< columns of LiveBlock::measured
  std::vector<std::string> places;      ///< columns of LiveBlock::simulated
  twin::ModesAtLoad modes;              ///< of the twin
  std::vector<std::string> mode_names;  ///< empty: by number, all with a band; "": by number, without a band
  std::vector<WatchedBand> bands;       ///< in addition to one at each mode
  std::optional<double> limit;          ///< m/s2, 0-peak in a band: the mill's own
  std::optional<ChatterWatch::Setup> chatter;
  LumpedModel chain;                                 ///< the twin's
  std::function<LumpedModel(double load)> chain_at;  ///< as the twin then is, at another force, N; empty: `chain`
  /// Of a detailed stand, in its modes, with the springs of this chain and the damping that the twin then has;
  /// empty: six masses.
  std::function<twin::FittedStand(const LumpedModel &chain)> detailed;
  /// Case of an adopted proposal and its other files; empty: calibrated_case().
  std::function<std::string(const Proposal &, const std::string &folder)> adopted_case;
  DynamicsSettings dynamics;
  std::vector<twin::Unknown> unknowns;  ///< that a re-calibration may move, with the last posterior's standard
                                        ///< deviations, which set_twin() renews for springs; empty: drift is
                                        ///< reported and nothing is proposed
  double recalibrate_on = 60;           ///< s, at least, since the change
  bool wait             = false;        ///< wait for background work, for tests
};
/// Springs that are not zero and "zeta": by the error estimates of the chain, at least 5 % where computed, 10 %
/// where given without one, factor 2 for the damping.
std::vector<twin::Unknown> unknowns_of(const LumpedModel &chain);

/// What there is to tell after a block.
struct ComparisonNews {
  std::optional<PageLevels> levels;    ///< each second
  std::vector<PageSpectrum> spectra;   ///< four times a second, of every place
  std::optional<PageModes> modes;      ///< every ten seconds
  std::optional<PageChatter> chatter;  ///< each second
  std::vector<PageAlarm> alarms;
  std::vector<PageProposal> proposals;
};
/// To the page, as its events.
void publish(const ComparisonNews &news, const Publish &publish);

/// Comparison of the twin with the measured: levels, spectra, onset of chatter, modes and their drift, critical
/// speed, proposals.  In the thread of the engine; searches and re-calibrations run in the background at lowest
/// priority. theory.md 50
class Comparison {
public:
  explicit Comparison(ComparisonSetup setup);
  ComparisonNews take(const LiveBlock &block);

  /// The twin was changed by hand or by a proposal.  When its modes are others, sums and references start again,
  /// open proposals are out of date, and a re-calibration that runs is not used.
  void set_twin(const LumpedModel &chain, const DynamicsSettings &dynamics, const twin::ModesAtLoad &modes);
  /// The stand of the critical speed has other springs; nothing where none is watched.
  void set_chatter(twin::ChatterModel model);
  /// As Proposals::adopt().  The twin goes on as it is until set_twin() is called with the chain returned.
  std::optional<Proposal> adopt(std::int64_t id, double utc, const std::string &folder, const Case &origin);

  const std::vector<Proposal> &proposals() const;
  std::vector<PageAlarm> open_alarms() const;
  TrackedModes drift() const;
  std::vector<ChatterBand> bands() const;

  /// Sums, references and baselines, open alarms, proposals: what a restarted program goes on from.
  nlohmann::json state() const;
  /// Before the first block.  Channels and bands are recognised by their names; those that do not exist any more
  /// are left out. Of a state that is not whole nothing is taken.
  /// @return why nothing was taken, a sentence; empty: it was
  std::string resume(const nlohmann::json &state);

  const std::vector<std::string> &notes() const;  ///< what cannot be compared, and why
  double busy() const;                            ///< s of this thread spent here so far

private:
  struct Pair {
    Eigen::Index channel, place;
    std::string name;
  };
  struct Stored;
  Stored read_state(const nlohmann::json &state) const;
  void add_levels(ComparisonNews &news, const twin::RunningComparison::News &compared, double start_time);
  void add_chatter(ComparisonNews &news, const LiveBlock &block, double utc);
  void watch_drift(double utc);
  void begin_recalibration(const ModeDrift &drift);
  void end_recalibration(double utc, twin::Recalibration result);

  ComparisonSetup setup_;
  std::vector<Pair> pairs;
  std::vector<Eigen::Index> watched;  // columns of LiveBlock::measured that are accelerations
  std::vector<std::string> remarks;
  twin::RunningComparison levels;
  OnsetMonitor onset;
  ModeTracker modes;
  std::optional<ChatterWatch> chatter;
  AlarmBook book;
  Proposals offered;
  std::optional<ModeDrift> waiting;   // an alarm whose data are not long enough yet
  std::optional<ModeDrift> answered;  // what is being re-calibrated; empty: its result is not wanted any more
  double from_ = 0, to_ = 0;          // s since 1970, of its data
  double load_ = 0;                   // N
  LowPriorityTask<twin::Recalibration> task;
  std::vector<double> baseline;  // m/s2, rms of the pairs while the mill was calm
  std::int64_t chatter_second = -1;
  std::string no_chatter      = "the case says nothing of chatter";
  double spent                = 0;
};
}  // namespace mill::live
