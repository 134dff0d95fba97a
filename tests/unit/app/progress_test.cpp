// What a user sees of the progress of a command, in the percent lines of a standard error that is not a terminal.
#include "app/process/console.h"
#include <gtest/gtest.h>
#include <random>
#include <sstream>
#include <thread>

using namespace mill;

namespace {
std::vector<int> percents_of(const std::string &text)
{
  std::vector<int> percents;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    percents.push_back(std::stoi(line));
  return percents;
}

void expect_never_falling(const std::vector<int> &percents)
{
  for (std::size_t i = 1; i < percents.size(); ++i)
    EXPECT_LE(percents[i - 1], percents[i]);
}
}  // namespace

TEST(Progress, NeverFallsWhateverTheStagesReport)
{
  const unsigned seed = 5;
  std::mt19937 random(seed);
  const char *const names[] = {"read", "fit", "read", "unknown"};
  for (int draw = 0; draw < 200; ++draw) {
    testing::internal::CaptureStderr();
    console::begin_progress();
    const int n_bars = 1 + int(random() % 4);
    for (int k = 0; k < n_bars; ++k) {
      if (random() % 2)
        console::next_bar_ends_at(double(k + 1) / n_bars);
      console::ProgressBar bar({{"read", 3}, {"fit", 1}, {"read", 2}}, false);
      for (int i = 0; i < 20; ++i)
        bar.show(names[random() % 4], double(random() % 101) / 100);
      bar.finish();
    }
    const auto percents = percents_of(testing::internal::GetCapturedStderr());
    ASSERT_FALSE(percents.empty());
    expect_never_falling(percents);
    EXPECT_LE(percents.back(), 100) << "seed " << seed << ", draw " << draw;
  }
}

TEST(Progress, OfSeveralPartsReachesTheEndOnce)
{
  testing::internal::CaptureStderr();
  console::begin_progress();
  for (const double end : {0.3, 0.6, 1.0}) {
    console::next_bar_ends_at(end);
    console::ProgressBar bar({{"part", 1}}, false);
    for (int i = 0; i <= 10; ++i)
      bar.show("part", 0.1 * i);
  }
  const auto percents = percents_of(testing::internal::GetCapturedStderr());
  expect_never_falling(percents);
  EXPECT_EQ(percents.front(), 0);
  EXPECT_EQ(percents.back(), 100);
  EXPECT_EQ(std::count(percents.begin(), percents.end(), 100), 1);
}

TEST(Progress, NeverFallsWhereStagesRunSideBySide)
{
  testing::internal::CaptureStderr();
  console::begin_progress();
  console::ProgressBar bar({{"a", 1}, {"b", 1}, {"c", 1}, {"d", 1}}, false);
  std::vector<std::thread> threads;
  for (const char *stage : {"a", "b", "c", "d"})
    threads.emplace_back([&bar, stage] {
      for (int i = 0; i <= 1000; ++i)
        bar.show(stage, 1e-3 * i);
    });
  for (std::thread &thread : threads)
    thread.join();
  expect_never_falling(percents_of(testing::internal::GetCapturedStderr()));
}
