#include "app/twin/live/live_alarms.h"
#include "app/twin/live/live_clock.h"
#include "twin/live/compare/stored_alarms.h"
#include "twin/live/compare/stored_object.h"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace mill {
namespace {
constexpr std::size_t stored_over = 50;   // alarms that are over
constexpr std::size_t most_shown  = 400;  // the page keeps 200
constexpr std::size_t most_open   = 1000;
}  // namespace

LiveAlarms::LiveAlarms(live::Publish publish) : publish_(std::move(publish)) {}

void LiveAlarms::raise(const std::string &cause, const std::string &kind, const std::string &level,
                       const std::string &text)
{
  const std::lock_guard lock(lock_);
  own_.raise(cause, utc_now(), kind, level, text);
}

void LiveAlarms::end(const std::string &cause)
{
  const std::lock_guard lock(lock_);
  own_.end(cause);
}

void LiveAlarms::publish_changes()
{
  std::vector<live::PageAlarm> news;
  {
    const std::lock_guard lock(lock_);
    news = own_.news();
  }
  for (const live::PageAlarm &alarm : news)
    show(alarm);
}

std::vector<live::PageAlarm> LiveAlarms::open() const
{
  const std::lock_guard lock(lock_);
  std::vector<live::PageAlarm> open;
  for (const auto &[cause, alarm] : own_.state().now)
    open.push_back(alarm);
  return open;
}

void LiveAlarms::show(live::PageAlarm alarm)
{
  {
    const std::lock_guard lock(lock_);
    live::PageAlarm &shown = shown_[alarm.id];
    alarm.acknowledged     = alarm.acknowledged || shown.acknowledged;
    shown                  = alarm;
    limit_shown();
  }
  publish_(live::event_names::alarm, live::alarm_text(alarm));
}

// The one that began first of those that are over goes; one that is open stays up to a number that bounds the
// memory. By their time, since the numbers of the comparison are all below those of source and recording.
void LiveAlarms::limit_shown()
{
  if (shown_.size() <= most_shown)
    return;
  auto goes = shown_.end();
  for (auto entry = shown_.begin(); entry != shown_.end(); ++entry)
    if (entry->second.over && (goes == shown_.end() || entry->second.utc < goes->second.utc))
      goes = entry;
  if (goes == shown_.end() && shown_.size() > most_open)
    goes = std::min_element(shown_.begin(), shown_.end(),
                            [](const auto &a, const auto &b) { return a.second.utc < b.second.utc; });
  if (goes != shown_.end())
    shown_.erase(goes);
}

void LiveAlarms::forget_comparison()
{
  std::vector<live::PageAlarm> ended;
  {
    const std::lock_guard lock(lock_);
    const auto end = shown_.lower_bound(first_own);
    for (auto entry = shown_.begin(); entry != end; ++entry)
      if (!std::exchange(entry->second.over, true))
        ended.push_back(entry->second);
    shown_.erase(shown_.begin(), end);
    acknowledged_.erase(acknowledged_.begin(), acknowledged_.lower_bound(first_own));
  }
  for (const live::PageAlarm &alarm : ended)
    publish_(live::event_names::alarm, live::alarm_text(alarm));
}

void LiveAlarms::show_all()
{
  std::map<std::int64_t, live::PageAlarm> all;  // a browser may acknowledge one already
  {
    const std::lock_guard lock(lock_);
    all = shown_;
  }
  for (const auto &[id, alarm] : all)
    publish_(live::event_names::alarm, live::alarm_text(alarm));
}

bool LiveAlarms::acknowledge(const std::int64_t id)
{
  const std::lock_guard lock(lock_);
  const auto shown = shown_.find(id);
  if (shown == shown_.end())
    return false;
  shown->second.acknowledged = true;
  acknowledged_.insert(id);
  return true;
}

void LiveAlarms::publish_acknowledged()
{
  std::vector<live::PageAlarm> news;
  {
    const std::lock_guard lock(lock_);
    for (const std::int64_t id : std::exchange(acknowledged_, {}))
      if (const auto shown = shown_.find(id); shown != shown_.end())
        news.push_back(shown->second);
  }
  for (const live::PageAlarm &alarm : news)
    publish_(live::event_names::alarm, live::alarm_text(alarm));
}

void LiveAlarms::store(nlohmann::json &run) const
{
  nlohmann::json shown = nlohmann::json::array();
  const std::lock_guard lock(lock_);
  auto over = std::size_t(
      std::count_if(shown_.begin(), shown_.end(), [](const auto &entry) { return entry.second.over; }));
  for (const auto &[id, alarm] : shown_) {
    if (alarm.over && over-- > stored_over)
      continue;
    shown.push_back(live::alarm_json(alarm));
  }
  run["own"]    = live::book_json(own_.state());
  run["alarms"] = std::move(shown);
}

void LiveAlarms::resume(const live::StoredObject &run)
{
  const auto stored = live::stored_book(run.object("own"));
  std::vector<live::PageAlarm> shown;
  for (const live::StoredObject &alarm : run.list("alarms", most_open))
    shown.push_back(live::stored_alarm(alarm));
  const std::lock_guard lock(lock_);
  own_.resume(stored);
  for (const live::PageAlarm &alarm : shown)
    shown_[alarm.id] = alarm;
}
}  // namespace mill
