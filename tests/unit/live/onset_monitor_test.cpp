// The mill's own limit, and a mill that is quiet: what the bands of a stream raise and what they do not.
#include "tests/support/near.h"
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
  OnsetMonitor monitor(rate, {"upper_work_roll"}, {{"third octave", at}}, limit);
  AlarmBook book;
  std::vector<PageAlarm> all;  // as the program asks for them: after each block
  for (Eigen::Index k = 0; k < n; k += 50) {
    monitor.take(k, 1.7e9, x.middleRows(k, 50), book);
    for (const PageAlarm &alarm : book.news())
      all.push_back(alarm);
  }
  return all;
}
}  // namespace

TEST(OnsetMonitor, RaisesAnAlarmAboveTheLimitWithoutABaseline)
{
  const auto loud = alarms_of(10, 0, 12, 10.0, 8);
  ASSERT_EQ(loud.size(), 2u);
  EXPECT_EQ(loud[0].level, "alarm");
  EXPECT_EQ(
      loud[0].text,
      "chatter at 100 Hz, upper_work_roll: 12.1 m/s2 is above the limit of 10 m/s2 that is set for this mill");
  EXPECT_LT(loud[0].utc, 1.7e9 + 0.5) << "there is no baseline yet";
  EXPECT_TRUE(loud[1].over);
  EXPECT_TRUE(alarms_of(10, 0, 9, 10.0).empty()) << "below it, and never calmer";
  EXPECT_TRUE(alarms_of(10, 0, 12, {}).empty()) << "no limit";
}

TEST(OnsetMonitor, StatesTheTimeToTheLimitAndTheLongestLead)
{
  const auto n      = Eigen::Index(50 * rate);
  Eigen::MatrixXd x = synthetic::white(17, n, rate, 0.005);
  for (Eigen::Index k = Eigen::Index(40 * rate); k < n; ++k)
    x(k, 0) += 0.01 * std::exp(4 * (double(k) / rate - 40)) * std::sin(2 * M_PI * at * double(k) / rate);
  OnsetMonitor monitor(rate, {"upper_work_roll"}, {{"third octave", at}}, 10.0);
  AlarmBook book;
  std::vector<PageAlarm> news;
  for (Eigen::Index k = 0; k < n && news.empty(); k += 50) {
    monitor.take(k, 1.7e9, x.middleRows(k, 50), book);
    news = book.news();
  }
  ASSERT_EQ(news.size(), 1u);
  const std::string &text = news[0].text;
  double seen = 0, level = 0, times = 0, growth = 0, left = 0, most = 0;
  ASSERT_EQ(std::sscanf(text.c_str(),
                        "chatter at %lf Hz, upper_work_roll: %lf m/s2 is %lf times the level while it was calm, "
                        "growing at %lf 1/s; the limit of 10 m/s2 in %lf s (at this growth no alarm leads it by "
                        "more than %lf s)",
                        &seen, &level, &times, &growth, &left, &most),
            6)
      << text;
  EXPECT_TRUE(
      near(seen, 100.,
           within_absolute(
               2.5, "at five times the noise the envelope turns by 1 to 2 Hz more or less, printed whole")));
  EXPECT_TRUE(
      near(left, std::log(10 / level) / growth,
           within_absolute(0.02, "amplitude, growth and time are printed with two digits after the point")))
      << "as printed: " << text;
  EXPECT_TRUE(
      near(most, std::log(10 / (5 * level / times)) / growth,
           within_absolute(0.02, "amplitude, growth and time are printed with two digits after the point")))
      << "from five baselines on: " << text;
  EXPECT_GT(growth, 3);
}

TEST(OnsetMonitor, DoesNotWarnOfASteadyTone)
{
  for (const double level : {0.02, 0.1, 1.0})
    EXPECT_TRUE(alarms_of(120, 0, level, {}).empty())
        << level << " m/s2: " << alarms_of(120, 0, level, {})[0].text;
}

namespace {
/// Calm noise for 30 s in two channels, then a vibration that grows from it at 4 1/s up to 20 m/s2.
struct Chatter {
  double frequency;                 // Hz
  std::vector<double> multiples{};  // of it, each a fifth as strong
};

std::vector<PageAlarm> alarms_of_chatter(const Chatter &chatter, const std::vector<WatchedBand> &bands)
{
  constexpr double fast = 4000, start = 30;  // Hz, s
  const auto n = Eigen::Index(36 * fast);
  Eigen::MatrixXd x(n, 2);
  for (Eigen::Index c = 0; c < 2; ++c)
    x.col(c) = synthetic::white(23 + std::uint64_t(c), n, fast, 0.005);
  for (auto k = Eigen::Index(start * fast); k < n; ++k) {
    const double t = double(k) / fast, level = std::min(20., 0.02 * std::exp(4 * (t - start)));
    double sum = std::sin(2 * M_PI * chatter.frequency * t);
    for (const double multiple : chatter.multiples)
      sum += 0.2 * std::sin(2 * M_PI * chatter.frequency * multiple * t);
    x(k, 0) += level * sum;
    x(k, 1) += 0.7 * level * sum;
  }
  OnsetMonitor monitor(fast, {"upper_work_roll", "lower_work_roll"}, bands, {});
  AlarmBook book;
  for (Eigen::Index k = 0; k < n; k += 80)
    monitor.take(k, 1.7e9, x.middleRows(k, 80), book);
  std::vector<PageAlarm> begun;
  for (const PageAlarm &alarm : book.news())
    if (!alarm.over)
      begun.push_back(alarm);
  return begun;
}

std::vector<WatchedBand> usual_bands_and_modes()
{
  auto bands       = bands_over("third octave", 125, 240);
  const auto fifth = bands_over("fifth octave", 550, 650);
  bands.insert(bands.end(), fifth.begin(), fifth.end());
  bands.push_back({"mode 3", 218.3, true});
  bands.push_back({"mode 4", 300.0, true});
  bands.push_back({"mode 5", 745.0, true});
  return bands;
}
}  // namespace

TEST(OnsetMonitor, RaisesOneAlarmForOneChatter)
{
  // between two bands, in two channels, up to 4000 times the noise of the other bands, with two multiples
  const auto alarms = alarms_of_chatter({151.7, {2, 4}}, usual_bands_and_modes());
  ASSERT_EQ(alarms.size(), 1u) << alarms[1].text;
  double seen = 0;
  ASSERT_EQ(std::sscanf(alarms[0].text.c_str(), "chatter at %lf Hz, ", &seen), 1) << alarms[0].text;
  EXPECT_TRUE(
      near(seen, 151.7,
           within_absolute(
               2.5, "at five times the noise the envelope turns by 1 to 2 Hz more or less, printed whole")));
  EXPECT_NE(alarms[0].text.find("; the nearest mode of the twin is mode 3 at 218.3 Hz"), std::string::npos)
      << alarms[0].text;
}

TEST(OnsetMonitor, NamesTheFrequencyItSawAndNotThatOfTheMode)
{
  const auto alarms = alarms_of_chatter({733.0}, usual_bands_and_modes());
  ASSERT_EQ(alarms.size(), 1u);
  double seen = 0;
  ASSERT_EQ(std::sscanf(alarms[0].text.c_str(), "chatter at %lf Hz, ", &seen), 1) << alarms[0].text;
  EXPECT_TRUE(
      near(seen, 733.0,
           within_absolute(
               2.5, "at five times the noise the envelope turns by 1 to 2 Hz more or less, printed whole")));
  EXPECT_NE(alarms[0].text.find("; the nearest mode of the twin is mode 5 at 745.0 Hz"), std::string::npos)
      << alarms[0].text;
}

TEST(OnsetMonitor, RaisesTwoAlarmsForTwoChatters)
{
  constexpr double fast = 4000;  // Hz
  const auto n          = Eigen::Index(40 * fast);
  Eigen::MatrixXd x     = synthetic::white(29, n, fast, 0.005);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = double(k) / fast;
    if (t > 30)
      x(k, 0) += std::min(1., 0.02 * std::exp(4 * (t - 30))) * std::sin(2 * M_PI * 151.7 * t);
    if (t > 34)
      x(k, 0) += std::min(1., 0.02 * std::exp(4 * (t - 34))) * std::sin(2 * M_PI * 583.0 * t);
  }
  OnsetMonitor monitor(fast, {"upper_work_roll"}, usual_bands_and_modes(), {});
  AlarmBook book;
  for (Eigen::Index k = 0; k < n; k += 80)
    monitor.take(k, 1.7e9, x.middleRows(k, 80), book);
  int begun = 0;
  for (const PageAlarm &alarm : book.news())
    begun += !alarm.over;
  EXPECT_EQ(begun, 2);
}
