#pragma once
#include "app/twin/live/console_lines.h"
#include "app/twin/live/live_alarms.h"
#include "twin/live/compare/comparison.h"
#include <map>
#include <mutex>
#include <string>

namespace mill {
/// What a run writes to the terminal.  print() and say() from the threads of engine and background, all else from
/// that of the engine.
class LiveConsole {
public:
  /// @param quiet   nothing but alarms of the recording is written
  /// @param alarms  get the notes of source and recording that raise one
  LiveConsole(bool quiet, LiveAlarms &alarms);

  void begin(const live::LiveSource &source);
  void take(const live::LiveBlock &block);      ///< a line for each second of record
  void take(const live::ComparisonNews &news);  ///< alarms whose level changed, proposals
  void print(const std::string &text);
  /// A note; of a kind 20 are shown.
  void say(const std::string &kind, const std::string &text);

private:
  bool quiet_ = false;
  LiveAlarms &alarms_;
  std::mutex lock_;  // of the terminal and of times_
  ConsoleLines lines_;
  std::map<std::int64_t, std::string> printed_;  // level of each open alarm
  std::map<std::string, std::int64_t> times_;    // notes by kind
};
}  // namespace mill
