#include "app/twin/live/live_alarms.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace mill;

namespace {
live::PageAlarm alarm_with(const std::int64_t id, const bool over)
{
  live::PageAlarm alarm;
  alarm.id    = id;
  alarm.kind  = "chatter";
  alarm.level = "alarm";
  alarm.text  = "chatter";
  alarm.over  = over;
  return alarm;
}

std::vector<std::int64_t> shown_by(const LiveAlarms &alarms)
{
  nlohmann::json run;
  alarms.store(run);
  std::vector<std::int64_t> ids;
  for (const auto &alarm : run["alarms"])
    ids.push_back(alarm["id"].get<std::int64_t>());
  return ids;
}
}  // namespace

// If they do not all fit, those that are over go first, the oldest of them before the others: the first
// alarm of a shift may be open still.
TEST(LiveAlarms, AnOpenAlarmStaysWhileOthersAreOver)
{
  LiveAlarms alarms([](const std::string &, const std::string &) {});
  alarms.show(alarm_with(1, false));
  for (std::int64_t id = 2; id <= 500; ++id)
    alarms.show(alarm_with(id, true));
  EXPECT_TRUE(alarms.acknowledge(1));
  EXPECT_FALSE(alarms.acknowledge(2));
  EXPECT_TRUE(alarms.acknowledge(500));
  const auto stored = shown_by(alarms);
  ASSERT_EQ(stored.size(), 51u) << "and the last fifty that are over";
  EXPECT_EQ(stored[0], 1);
  EXPECT_EQ(stored[1], 451);
}

// More are open than are kept of those that are over: all stay, and the next one that is over goes at once.
TEST(LiveAlarms, ManyOpenAlarmsStay)
{
  LiveAlarms alarms([](const std::string &, const std::string &) {});
  for (std::int64_t id = 1; id <= 500; ++id)
    alarms.show(alarm_with(id, false));
  alarms.show(alarm_with(501, true));
  EXPECT_EQ(shown_by(alarms).size(), 500u);
  EXPECT_TRUE(alarms.acknowledge(1));
  EXPECT_FALSE(alarms.acknowledge(501));
}

// Those of source and recording have higher numbers than those of the comparison; of all that are over the one
// that began first goes.
TEST(LiveAlarms, TheOldestThatIsOverGoesFirst)
{
  LiveAlarms alarms([](const std::string &, const std::string &) {});
  live::PageAlarm alarm = alarm_with(1'000'000, true);
  alarm.utc             = 1.7e9;
  alarms.show(alarm);
  for (alarm.id = 1; alarm.id <= 400; ++alarm.id) {
    alarm.utc += 60;
    alarms.show(alarm);
  }
  EXPECT_FALSE(alarms.acknowledge(1'000'000)) << "401 do not fit in 400";
  EXPECT_TRUE(alarms.acknowledge(1));
}

// Those of source and recording have other numbers and stay; an open page hears that the others are over.
TEST(LiveAlarms, AComparisonThatIsLostTakesItsAlarmsAlong)
{
  std::vector<std::string> published;
  LiveAlarms alarms([&](const std::string &, const std::string &json) { published.push_back(json); });
  alarms.show(alarm_with(1, false));
  alarms.show(alarm_with(2, true));
  alarms.raise("gap", "gap", "warning", "12 samples are missing");
  alarms.publish_changes();
  published.clear();
  alarms.forget_comparison();
  ASSERT_EQ(published.size(), 1u);
  EXPECT_EQ(nlohmann::json::parse(published[0])["id"], 1);
  EXPECT_EQ(nlohmann::json::parse(published[0])["over"], true);
  EXPECT_FALSE(alarms.acknowledge(1));
  EXPECT_EQ(shown_by(alarms), std::vector<std::int64_t>{1'000'000});
}
