#include "app/twin/live/live_run.h"
#include "core/base/visible_text.h"
#include "twin/live/compare/stored_alarms.h"
#include "twin/live/compare/stored_object.h"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

// What of a live run survives its end: written each second, read at the next start.
namespace mill {
namespace {
constexpr std::size_t told_again = 50;   // alarms that are over
constexpr std::size_t most_shown = 400;  // as many as a run keeps
constexpr std::int64_t no_number = std::numeric_limits<std::int64_t>::min();
}  // namespace

// Alarms as they were sent to the page; of those that are over the last ones.
void LiveRun::store_state()
{
  using Json       = nlohmann::json;
  auto state       = engine_->state();
  const auto until = recorder_->next();
  Json shown       = Json::array();
  Json run{{"recorded", until == no_number ? Json() : Json(until)}};
  {
    const std::lock_guard lock(alarm_lock_);
    std::size_t over = std::size_t(std::count_if(shown_alarms_.begin(), shown_alarms_.end(),
                                                 [](const auto &entry) { return entry.second.over; }));
    for (const auto &[id, alarm] : shown_alarms_) {
      if (alarm.over && over-- > told_again)
        continue;
      shown.push_back(live::alarm_json(alarm));
    }
    run["own"] = live::book_json(alarms_.state());
  }
  run["alarms"] = std::move(shown);
  state["run"]  = std::move(run);
  if (comparison_)
    state["comparison"] = comparison_->state();
  states_ += state_->write(state, *background_, [this](const std::string &why) { say("recording", why); });
}

// The state that an earlier program of the same case left with its recording.
void LiveRun::resume()
{
  if (!state_ || command_.fresh)
    return;
  const auto stored  = state_->read([this](const std::string &why) { print(why + "\n"); });
  std::int64_t until = 0;
  if (stored) {
    if (const auto learned = stored->find("comparison"); learned != stored->end())
      learned_ = std::make_unique<nlohmann::json>(*learned);
    const std::string said = engine_->resume(*stored);
    if (!said.empty())
      print(visible(said, false) + "\n");
    model_  = engine_->model();
    origin_ = model_.adopted.empty() ? origin_ : model_.adopted;
    if (engine_->source() || !model_.adopted.empty()) {
      try {
        const live::StoredObject run = live::StoredObject(*stored, "it").object("run");
        if (const double recorded =
                run.number_or_unknown("recorded", -double(live::largest_number), double(live::largest_number));
            recorded == recorded)
          until = std::int64_t(recorded);
        resume_alarms(run);
      } catch (const live::DamagedState &damage) {
        print(visible(fmt::format("alarms of the stored state cannot be used: {}", damage.what()), true) + "\n");
      }
    } else {
      learned_.reset();  // of another case, or of another version
    }
  }
  resume_recording(until);
}

void LiveRun::resume_alarms(const live::StoredObject &run)
{
  const auto stored = live::stored_book(run.object("own"));
  std::vector<live::PageAlarm> shown;
  for (const live::StoredObject &alarm : run.list("alarms", most_shown))
    shown.push_back(live::stored_alarm(alarm));
  const std::lock_guard lock(alarm_lock_);
  alarms_.resume(stored);
  for (const live::PageAlarm &alarm : shown)
    shown_alarms_[alarm.id] = alarm;
}

// Rows that are on the disk already are not recorded again.
void LiveRun::resume_recording(const std::int64_t recorded)
{
  if (engine_->resumed_at() == 0 || !engine_->source()) {
    // killed before a state was there: what its last file holds is not recorded again
    for (const live::FinishedPart &part : finished_)
      if (part.source == input_.target)
        recorder_->resume(part.next);
    return;
  }
  const live::LiveSource &source = *engine_->source();
  next_                          = engine_->resumed_at();
  if (source.name == input_.target)
    skip_to_ = engine_->resumed_at();
  assumed_         = live::SourceHead{source.rate, source.start_time, source.name, source.channels, source.factor};
  const auto some  = std::int64_t(120 * source.rate);  // a file is at most that long
  const auto known = recorded_up_to(command_.live.record, source, engine_->resumed_at() - some);
  // a number ahead of every sample that was seen is wrong: nothing would be recorded up to it
  recorder_->resume(std::max(known.value_or(0), std::min(recorded, engine_->resumed_at())));
}
}  // namespace mill
