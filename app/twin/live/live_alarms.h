#pragma once
#include "twin/live/compare/alarm_book.h"
#include "twin/live/live_block.h"
#include "twin/live/page/event_text.h"
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace mill {
namespace live {
class StoredObject;
}

/// Alarms of a run: those of source and recording, and all as the page last had them.  Raised, ended and
/// acknowledged in any thread, published in that of the engine.
class LiveAlarms {
public:
  explicit LiveAlarms(live::Publish publish);

  /// An alarm of source or recording, published with the next publish_changes().  Arguments as of live::AlarmBook.
  void raise(const std::string &cause, const std::string &kind, const std::string &level, const std::string &text);
  void end(const std::string &cause);
  void publish_changes();
  std::vector<live::PageAlarm> open() const;  ///< of source and recording

  /// Publishes an alarm; one that was seen stays seen when it changes or ends.
  void show(live::PageAlarm alarm);
  /// The comparison has lost its state and gives its numbers again: its alarms are over and no longer known.
  void forget_comparison();
  void show_all();                    ///< as the page last had them, after a restart
  bool acknowledge(std::int64_t id);  ///< false: not shown; published with the next publish_acknowledged()
  void publish_acknowledged();

  /// Members "own" and "alarms" of the stored state; of those that are over the last 50.
  void store(nlohmann::json &run) const;
  /// @throws live::DamagedState  then nothing is taken
  void resume(const live::StoredObject &run);

private:
  void limit_shown();  // the lock is held

  live::Publish publish_;
  mutable std::mutex lock_;
  static constexpr std::int64_t first_own = 1'000'000;  // numbers below it are of the comparison
  live::AlarmBook own_{first_own};
  std::map<std::int64_t, live::PageAlarm> shown_;
  std::set<std::int64_t> acknowledged_;  // not yet published
};
}  // namespace mill
