// The mill's own limit, and a mill that is quiet: what the bands of a stream raise and what they do not.
#include "tests/support/synthetic_record.h"
#include "twin/live/compare/onset_monitor.h"
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

using namespace mill::live;

namespace {
constexpr double rate = 500, at = 100;  // Hz

// Calm noise for a while, then a tone of some level.
std::vector<PageAlarm> alarms_of(const double seconds, const double from, const double level,
                                 const std::optional<double> limit, const double until = 1e9)
{
  const auto n      = Eigen::Index(seconds * rate);
  Eigen::MatrixXd x = synthetic::white(17, n, rate, 0.005);
  for (Eigen::Index k = Eigen::Index(from * rate); k < n; ++k)
    if (double(k) < until * rate)
      x(k, 0) += level * std::sin(2 * M_PI * at * double(k) / rate);
  OnsetMonitor monitor(rate,
                       {
                           "upper_work_roll"
  },
                       {{"third octave", at}}, limit);
  AlarmBook book;
  for (Eigen::Index k = 0; k < n; k += 50)
    monitor.take(k, 1.7e9, x.middleRows(k, 50), book);
  return book.news();
}
}  // namespace

TEST(OnsetMonitor, AboveTheLimitIsAnAlarmHoweverLoudItWasBefore)
{
  const auto loud = alarms_of(10, 0, 12, 10.0, 8);
  ASSERT_EQ(loud.size(), 2u);
  EXPECT_EQ(loud[0].level, "alarm");
  EXPECT_EQ(loud[0].text,
            "third octave at 100.0 Hz, upper_work_roll: 12 m/s2 is above the limit of 10 m/s2 that is "
            "set for this mill");
  EXPECT_LT(loud[0].utc, 1.7e9 + 0.5) << "there is no baseline yet";
  EXPECT_TRUE(loud[1].over);
  EXPECT_TRUE(alarms_of(10, 0, 9, 10.0).empty()) << "below it, and never calmer";
  EXPECT_TRUE(alarms_of(10, 0, 12, {}).empty()) << "no limit";
}

TEST(OnsetMonitor, TheTimeToTheLimitIsToldWithWhatCouldBeHad)
{
  const auto n      = Eigen::Index(50 * rate);
  Eigen::MatrixXd x = synthetic::white(17, n, rate, 0.005);
  for (Eigen::Index k = Eigen::Index(40 * rate); k < n; ++k)
    x(k, 0) += 0.01 * std::exp(4 * (double(k) / rate - 40)) * std::sin(2 * M_PI * at * double(k) / rate);
  OnsetMonitor monitor(rate,
                       {
                           "upper_work_roll"
  },
                       {{"third octave", at}}, 10.0);
  AlarmBook book;
  std::vector<PageAlarm> news;
  for (Eigen::Index k = 0; k < n && news.empty(); k += 50) {
    monitor.take(k, 1.7e9, x.middleRows(k, 50), book);
    news = book.news();
  }
  ASSERT_EQ(news.size(), 1u);
  const std::string &text = news[0].text;
  double level = 0, times = 0, growth = 0, left = 0, most = 0;
  ASSERT_EQ(
      std::sscanf(text.c_str(),
                  "third octave at 100.0 Hz, upper_work_roll: %lf m/s2 is %lf times the level while it was "
                  "calm, growing at %lf 1/s; the limit of 10 m/s2 in %lf s (at this growth no alarm leads it "
                  "by more than %lf s)",
                  &level, &times, &growth, &left, &most),
      5)
      << text;
  EXPECT_NEAR(left, std::log(10 / level) / growth, 0.02) << "as printed: " << text;
  EXPECT_NEAR(most, std::log(10 / (5 * level / times)) / growth, 0.02) << "from five baselines on: " << text;
  EXPECT_GT(growth, 3);
}

TEST(OnsetMonitor, AQuietMillWithASteadyToneIsNotWarned)
{
  for (const double level : {0.02, 0.1, 1.0})
    EXPECT_TRUE(alarms_of(120, 0, level, {}).empty())
        << level << " m/s2: " << alarms_of(120, 0, level, {})[0].text;
}
