#pragma once
#include "twin/live/page/event_text.h"
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mill::live {
/// Alarms by their cause: one of a cause at a time, with a number that stays until its cause is gone.
class AlarmBook {
public:
  /// @param first_id  of the first alarm; others who raise alarms take other numbers
  explicit AlarmBook(std::int64_t first_id = 1);
  /// Begins or changes an alarm.
  /// @param cause  "chatter 128 Hz": recognises it
  void raise(const std::string &cause, double utc, const std::string &kind, const std::string &level,
             const std::string &text);
  /// Its cause is gone; nothing where there is none.
  void end(const std::string &cause);
  bool open(const std::string &cause) const;
  std::string level(const std::string &cause) const;  ///< empty: not open
  /// What changed since the last call, each alarm once and as it now is, in the order of the last changes.
  std::vector<PageAlarm> news();

  /// What a restarted program goes on from.
  struct State {
    std::int64_t next = 1;                 ///< number of the next alarm
    std::map<std::string, PageAlarm> now;  ///< open ones, by cause
  };
  const State &state() const;
  /// Earlier alarms are not reported again; present alarms keep their causes, and no number is used twice.
  void resume(State stored);

private:
  void note_change(const PageAlarm &alarm);

  State all;
  std::vector<PageAlarm> changed;
};
}  // namespace mill::live
