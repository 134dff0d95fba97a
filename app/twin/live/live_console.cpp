#include "app/twin/live/live_console.h"
#include "app/process/console.h"
#include "core/base/choice.h"
#include "core/base/visible_text.h"
#include <fmt/format.h>

namespace mill {
namespace {
// Notes of the source and of the recorder that raise an alarm.
enum class AlarmingNote { recording, response, loss, gap, overrun, rate, clock };
constexpr auto words_of(AlarmingNote)
{
  return choice_words<AlarmingNote>("recording", "response", "loss", "gap", "overrun", "rate", "clock");
}

constexpr std::int64_t shown_of_a_kind = 20;  // refusals and the like
}  // namespace

LiveConsole::LiveConsole(const bool quiet, LiveAlarms &alarms) : quiet_(quiet), alarms_(alarms) {}

void LiveConsole::begin(const live::LiveSource &source)
{
  lines_.begin(source);
}

void LiveConsole::take(const live::LiveBlock &block)
{
  if (const std::string line = lines_.take(block); !line.empty())
    print(line);
}

void LiveConsole::take(const live::ComparisonNews &news)
{
  for (const live::PageAlarm &alarm : news.alarms) {
    if (!alarm.over && printed_[alarm.id] != alarm.level)
      print(fmt::format("{}: {}\n", alarm.level, visible(alarm.text, true)));
    if (alarm.over)
      printed_.erase(alarm.id);
    else
      printed_[alarm.id] = alarm.level;
  }
  for (const live::PageProposal &proposal : news.proposals)
    print(fmt::format("proposal {} ({}): {}\n", proposal.id, proposal.state, visible(proposal.text, true)));
}

void LiveConsole::print(const std::string &text)
{
  if (quiet_)
    return;
  const std::lock_guard lock(lock_);
  console::print(text);
  console::flush();
}

void LiveConsole::say(const std::string &kind, const std::string &text)
{
  const std::string shown = visible(text, true);
  std::int64_t times      = 0;
  {
    const std::lock_guard lock(lock_);
    times = ++times_[kind];
  }
  const auto alarm = choice_named<AlarmingNote>(kind);
  const bool stops = alarm == AlarmingNote::recording || alarm == AlarmingNote::response;
  if (alarm)
    alarms_.raise(kind,
                  stops                         ? "recording"
                  : *alarm == AlarmingNote::gap ? "gap"
                                                : "source",
                  stops ? "alarm" : "warning", shown);
  if (times == shown_of_a_kind + 1)
    print(fmt::format("{}: further ones are counted and not shown\n", kind));
  if (times > shown_of_a_kind)
    return;
  if (stops) {
    const std::lock_guard lock(lock_);
    console::say("alarm: " + shown + "\n");
  } else
    print(kind + ": " + shown + "\n");
}
}  // namespace mill
