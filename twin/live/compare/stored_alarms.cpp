#include "twin/live/compare/stored_alarms.h"
#include <nlohmann/json.hpp>

namespace mill::live {
namespace {
constexpr std::size_t most_open = 10000, stored_bytes = 4000;
}

nlohmann::json alarm_json(const PageAlarm &alarm)
{
  return {{"id", alarm.id},       {"utc", alarm.utc},
          {"kind", alarm.kind},   {"text", alarm.text.substr(0, stored_bytes)},
          {"level", alarm.level}, {"acknowledged", alarm.acknowledged},
          {"over", alarm.over}};
}

PageAlarm stored_alarm(const StoredObject &stored)
{
  PageAlarm alarm;
  alarm.id           = stored.count("id", 1, largest_number);
  alarm.utc          = stored.number("utc", earliest_time, latest_time);
  alarm.kind         = stored.text("kind");
  alarm.text         = stored.text("text");
  alarm.level        = stored.text("level");
  alarm.acknowledged = stored.flag("acknowledged");
  alarm.over         = stored.flag("over");
  return alarm;
}

nlohmann::json book_json(const AlarmBook::State &book)
{
  nlohmann::json open = nlohmann::json::array();
  for (const auto &[cause, alarm] : book.now)
    open.push_back({{"cause", cause}, {"alarm", alarm_json(alarm)}});
  return {{"next", book.next}, {"open", open}};
}

AlarmBook::State stored_book(const StoredObject &stored)
{
  AlarmBook::State book;
  book.next = stored.count("next", 1, largest_number);
  for (const StoredObject &one : stored.list("open", most_open)) {
    const PageAlarm alarm = stored_alarm(one.object("alarm"));
    if (alarm.id >= book.next || alarm.over)
      stored.refuse("has an open alarm with a number that is not given yet");
    book.now[one.text("cause")] = alarm;
  }
  return book;
}
}  // namespace mill::live
