#include "live/compare/alarm_book.h"
#include <utility>

namespace mill::live {
AlarmBook::AlarmBook(const std::int64_t first_id) : next(first_id) {}

void AlarmBook::raise(const std::string &cause, const double utc, const std::string &kind,
                      const std::string &level, const std::string &text)
{
  const auto known = now.find(cause);
  PageAlarm alarm;
  if (known != now.end()) {
    if (known->second.text == text && known->second.level == level)
      return;
    alarm = known->second;
  } else {
    alarm.id  = next++;
    alarm.utc = utc;
  }
  alarm.kind  = kind;
  alarm.level = level;
  alarm.text  = text;
  now[cause]  = alarm;
  changed.push_back(alarm);
}

void AlarmBook::end(const std::string &cause)
{
  const auto known = now.find(cause);
  if (known == now.end())
    return;
  known->second.over = true;
  changed.push_back(known->second);
  now.erase(known);
}

bool AlarmBook::open(const std::string &cause) const
{
  return now.count(cause) > 0;
}

std::vector<PageAlarm> AlarmBook::news()
{
  return std::exchange(changed, {});
}
}  // namespace mill::live
