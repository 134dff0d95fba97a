#pragma once
#include "twin/chatter/critical_track.h"
#include "twin/live/compare/alarm_book.h"
#include "twin/live/compare/low_priority_task.h"
#include "twin/live/live_block.h"
#include "twin/live/page/event_text.h"
#include <Eigen/Core>
#include <array>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace mill::live {
/// Distance to the critical speed, second by second, from speed, tensions and thicknesses of the stream.
/// theory.md 50.6
class ChatterWatch {
public:
  static constexpr const char *cause = "critical speed";  ///< of its alarm
  struct Setup {
    twin::ChatterModel model;
    std::vector<twin::InputDoubt> doubts = twin::usual_doubts();
    double rescan                        = 60;  ///< s, from search to search of the whole range
    bool wait = false;  ///< for every search, for tests; otherwise it runs in the background
  };
  /// Channels that count: speed (of the roll's surface) or exit_speed, entry_thickness, exit_thickness (lengths),
  /// entry_tension, exit_tension (stresses, or forces over the section of the strip).  Others are left alone; what
  /// is not there is taken from the case.
  ChatterWatch(Setup setup, const std::vector<LiveChannel> &channels, double rate);

  /// @param growth  measured in the watched bands, for the judgement: upper end of the 95 % interval,
  ///                1/s, NaN: not known
  /// A row where a second is over.  Cost of it: 1 ms.
  std::optional<PageChatter> take(const LiveBlock &block, double growth, AlarmBook &book);

  /// The stand has other springs from now on: the range is searched again.
  void set_model(twin::ChatterModel model);

  /// Of the last second.
  struct Second {
    twin::ChatterInputs inputs;
    double speed = unknown;  ///< m/s, of the roll's surface
    twin::CriticalPoint critical;
    twin::CriticalInterval interval;
    double spread = unknown;  ///< -, of the three linearisations, at the last search
    double growth = unknown;  ///< 1/s, computed at the speed of this second
    double took   = 0;        ///< s, of the computation
  };
  const Second &last() const;
  const std::vector<std::string> &notes() const;  ///< what of the channels is not understood
  bool has_speed() const;

private:
  enum Input { speed, exit_speed, entry_thickness, exit_thickness, entry_tension, exit_tension, n_inputs };
  struct Search {
    dynamics::CriticalSpeed critical;
    double spread   = unknown;
    double followed = unknown;  // m/s, what was followed at the same inputs
    std::string trouble;
    int model_number = 0;
  };
  PageChatter close_second(double utc, double growth, AlarmBook &book);
  twin::ChatterInputs inputs_of_second();
  double roll_speed(const bite::RollBite &bite) const;
  void search(const bite::RollBite &bite);
  void take_search(Search search);
  void judge(double utc, double growth, AlarmBook &book);

  Setup setup_;
  std::int64_t per_second;
  std::array<int, n_inputs> column{};  // of the block; -1: none
  std::array<bool, n_inputs> is_force{};
  std::array<double, n_inputs> to_si_{};  // a source leaves lengths and stresses as they are
  std::array<double, n_inputs> sum{}, mean{};
  std::array<std::int64_t, n_inputs> n{};
  std::int64_t second = -1;
  double since_search = 0;                   // s
  int beyond          = 0;                   // seconds in a row above the critical speed
  std::deque<double> speeds;                 // m/s, of the last minute
  std::optional<twin::CriticalTrack> track;  // always set; replaced with another stand
  int model_number = 0;
  std::string no_speed;  // why no critical speed is known
  LowPriorityTask<Search> task;
  Second now;
  std::vector<std::string> remarks;
};
}  // namespace mill::live
