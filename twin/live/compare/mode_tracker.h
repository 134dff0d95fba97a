#pragma once
#include "twin/drift/mode_watch.h"
#include "twin/live/compare/alarm_book.h"
#include "twin/live/page/event_text.h"
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mill::live {
/// Lines of ten seconds, and when that was.
struct ModeBlock {
  std::int64_t number = 0;           ///< of the block, from the first
  double utc          = 0;           ///< s since 1970, of its end
  double load         = 0;           ///< N, mean force
  twin::BlockSpectra spectra;        ///< up to 1.3 times the highest mode
  std::vector<std::size_t> sensors;  ///< of the channels, columns of the response: those without a missing sample
};

/// A mode that moved away.
struct ModeDrift {
  std::size_t mode;
  twin::Shift shift;   ///< in blocks
  double change;       ///< -, ln of the frequency now over what it was before
  double since, time;  ///< s since 1970
  std::int64_t from;   ///< number of the first block after the change
};

/// Sums of all modes, what a restarted program goes on from.  A block that was being collected is not among it.
struct TrackedModes {
  /// Where a sum left zero for the last time: end of the block before, number of the block behind.
  struct Since {
    double utc         = unknown;  ///< s since 1970; NaN: no block yet
    std::int64_t block = 0;
  };
  struct Mode {
    twin::ModeWatch::State watch;
    Since up, down;
  };
  std::int64_t blocks = 0;  ///< so far
  std::vector<Mode> modes;
};

/// Every ten seconds the frequency of each mode against the twin at the present load, and its cumulative sums.
/// theory.md 50.4, 50.5.  The work on a block is spread over the calls that follow it.
class ModeTracker {
public:
  struct Setup {
    double rate = 0;                  ///< Hz
    std::vector<std::string> places;  ///< of the channels
    twin::ModesAtLoad modes;          ///< of the twin
    std::vector<std::string> names;   ///< of the modes; empty: by number
    double seconds       = 10;        ///< of a block
    int kept_blocks      = 18;        ///< for a re-calibration
    int reference_blocks = 12;
    twin::CusumRule rule;
  };
  explicit ModeTracker(Setup setup);
  ~ModeTracker();

  /// @param force     (n) N, its mean included
  /// @param measured  (n, channels) m/s2
  /// The table of modes where a block is done.
  /// Cost at 20 kHz and 4 channels: 5 transforms of 200000 and a fit of some ms per mode every ten seconds.
  std::optional<PageModes> take(std::int64_t first, double start_time, const Eigen::VectorXd &force,
                                const Eigen::MatrixXd &measured, AlarmBook &book);
  /// After a gap: the block that is being collected is dropped.
  void restart();
  /// The twin was changed: other frequencies, sums at zero, new references.
  void set_twin(const twin::ModesAtLoad &modes);

  /// An alarm is known by this cause.
  static std::string cause_of(std::size_t mode);

  TrackedModes tracked() const;
  void resume(const TrackedModes &stored);         ///< of as many modes; otherwise nothing is taken
  std::vector<ModeDrift> drifts();                 ///< since the last call
  const std::deque<ModeBlock> &blocks() const;     ///< the last ones, oldest first
  const std::vector<twin::ModeRow> &rows() const;  ///< of the last block
  const Setup &setup() const;

private:
  struct State;
  std::unique_ptr<State> state;
};
}  // namespace mill::live
