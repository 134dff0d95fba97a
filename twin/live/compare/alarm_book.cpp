#include "twin/live/compare/alarm_book.h"
#include <algorithm>
#include <utility>

namespace mill::live {
AlarmBook::AlarmBook(const std::int64_t first_id)
{
  all.next = first_id;
}

void AlarmBook::raise(const std::string &cause, const double utc, const std::string &kind,
                      const std::string &level, const std::string &text)
{
  const auto known = all.now.find(cause);
  PageAlarm alarm;
  if (known != all.now.end()) {
    if (known->second.text == text && known->second.level == level)
      return;
    alarm = known->second;
  } else {
    alarm.id  = all.next++;
    alarm.utc = utc;
  }
  alarm.kind     = kind;
  alarm.level    = level;
  alarm.text     = text;
  all.now[cause] = alarm;
  note_change(alarm);
}

void AlarmBook::note_change(const PageAlarm &alarm)
{
  const auto before =
      std::find_if(changed.begin(), changed.end(), [&](const PageAlarm &a) { return a.id == alarm.id; });
  if (before != changed.end())
    changed.erase(before);
  changed.push_back(alarm);
}

void AlarmBook::end(const std::string &cause)
{
  const auto known = all.now.find(cause);
  if (known == all.now.end())
    return;
  known->second.over = true;
  note_change(known->second);
  all.now.erase(known);
}

bool AlarmBook::open(const std::string &cause) const
{
  return all.now.count(cause) > 0;
}

std::string AlarmBook::level(const std::string &cause) const
{
  const auto known = all.now.find(cause);
  return known == all.now.end() ? "" : known->second.level;
}

const AlarmBook::State &AlarmBook::state() const
{
  return all;
}

void AlarmBook::resume(State stored)
{
  all.next = std::max(all.next, stored.next);
  all.now.insert(stored.now.begin(), stored.now.end());
}

std::vector<PageAlarm> AlarmBook::news()
{
  return std::exchange(changed, {});
}
}  // namespace mill::live
