// Rate and clocks of a source that sets its own pace, on a made clock.
#include "tests/support/near.h"
#include "twin/live/source/arrival_watch.h"
#include <gtest/gtest.h>
#include <vector>

using namespace mill::live;

namespace {
using Kind = ArrivalWatch::News::Kind;

// Blocks of 0.1 s at a stated 1000 Hz.
class MadeSource {
public:
  MadeSource()
  {
    watch.begin(1000);
  }
  // @param factor  of the samples that come over those that should
  void run(const double seconds, const double factor, const double waiting = 0)
  {
    for (int i = 0; i < int(seconds * 10 + 0.5); ++i) {
      steady += 0.1;
      sent += 100 * factor;
      const auto next = std::int64_t(sent);
      keep(watch.arrived(next, next - last, {steady, 1.7e9 + steady}, waiting));
      last = next;
      if (i % 10 == 0)
        keep(watch.look({steady, 1.7e9 + steady + set}));
    }
  }
  void keep(const std::optional<ArrivalWatch::News> &news)
  {
    if (news)
      reports.push_back(*news);
  }
  ArrivalWatch watch;
  std::vector<ArrivalWatch::News> reports;
  double steady = 0, sent = 0, set = 0;
  std::int64_t last = 0;
};
}  // namespace

TEST(ArrivalWatch, ReportsNothingForTheStatedRate)
{
  for (const double factor : {1.0, 1.015, 0.985}) {
    MadeSource source;
    source.run(300, factor);
    EXPECT_TRUE(source.reports.empty()) << source.reports[0].text;
    EXPECT_TRUE(
        near(source.watch.rate(), 1000 * factor, within_absolute(0.5, "whole samples arrive every 0.1 s")));
  }
}

TEST(ArrivalWatch, ReportsAWrongRateOnceUntilItIsRight)
{
  MadeSource source;
  source.run(55, 1.25);
  EXPECT_TRUE(source.reports.empty()) << "two windows are not enough";
  source.run(60, 1.25);
  ASSERT_EQ(source.reports.size(), 1u);
  EXPECT_EQ(source.reports[0].kind, Kind::wrong_rate);
  EXPECT_EQ(
      source.reports[0].text,
      "samples arrive at 1250 Hz by the clock of this machine, 3 times in a row over 20 s, where their source "
      "states 1000 Hz: 25.0 % more. Every frequency and growth rate is wrong by as much; correct the rate "
      "(\"rate\" of the head, --rate for a file without times), or the clock of the source");
  EXPECT_TRUE(source.watch.wrong());
  source.run(100, 1);
  ASSERT_EQ(source.reports.size(), 2u);
  EXPECT_EQ(source.reports[1].kind, Kind::right_again);
  EXPECT_EQ(source.reports[1].text, "samples arrive at 1000 Hz again, as their source states");
  MadeSource slow;
  slow.run(70, 0.5);
  ASSERT_EQ(slow.reports.size(), 1u);
  EXPECT_NE(slow.reports[0].text.find("states 1000 Hz: 50.0 % less"), std::string::npos) << slow.reports[0].text;
}

TEST(ArrivalWatch, DoesNotReportPlayedOrWaitingSources)
{
  MadeSource played;
  played.run(200, 50);
  ASSERT_EQ(played.reports.size(), 1u);
  EXPECT_EQ(played.reports[0].kind, Kind::played);
  EXPECT_EQ(played.reports[0].text,
            "samples arrive 50 times as fast as the 1000 Hz of their source: taken for a record "
            "that is played, or for one that catches up");
  MadeSource busy;  // the twin does not keep pace and stops reading: that is not the source's rate
  busy.run(200, 0.8, 1.9);
  EXPECT_TRUE(busy.reports.empty());
}

TEST(ArrivalWatch, ClocksAndNumbersThatJump)
{
  MadeSource source;
  source.run(30, 1);
  source.sent += 60e3;
  source.last += 60000;  // the block itself is as long as ever
  source.run(1, 1);
  ASSERT_EQ(source.reports.size(), 1u);
  EXPECT_EQ(source.reports[0].kind, Kind::jump);
  EXPECT_EQ(source.reports[0].text.substr(0, 77),
            "the numbers of the samples jump ahead by 60.0 s more than has passed: the clo");
  source.set = -3600;
  source.run(2, 1);
  ASSERT_EQ(source.reports.size(), 2u);
  EXPECT_EQ(
      source.reports[1].text,
      "the clock of this machine was set back by 3600.0 s: times of alarms and of a source that does not say "
      "when it began follow it, numbers of samples do not");
  source.steady += 60;  // lost meanwhile, and counted by their numbers: no jump
  source.sent += 60e3;
  source.last += 60000;
  source.run(70, 1);
  EXPECT_EQ(source.reports.size(), 2u);
}
