#include "app/twin/live/live_sources.h"
#include "app/twin/live/live_state.h"
#include "app/twin/live/processor_share.h"
#include "core/base/errors.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <atomic>
#include <cmath>
#include <ctime>
#include <gtest/gtest.h>
#include <thread>

using namespace mill;

namespace {
constexpr double ten = 1767607200.0;  // s since 1970, 2026-01-05T10:00:00Z

live::SourceHead head_of(const double rate, const std::optional<double> start, const std::string &name = "daq-1")
{
  return {rate, start, name, {{"force", "N"}}, {1}};
}

struct Waiting {
  LiveSources sources{LiveInput{LiveInput::Kind::tcp, "127.0.0.1:0"}};
  Waiting(const bool start_known, const std::int64_t next)
  {
    sources.begin({"daq-1", 1000, ten, {{"force", "N"}}, {}, {1}}, start_known);
    sources.set_next(next);
  }
};
}  // namespace

// A sender keeps samples by its own numbers.  By hand: at 1 kHz a recorder that began an hour after the source has
// numbers that are 3 600 000 lower.
TEST(LiveSources, ASenderHearsItsOwnNumber)
{
  const Waiting waiting(true, 4'000'000);
  const LiveSources &sources = waiting.sources;
  EXPECT_EQ(sources.next_of(head_of(1000, ten)), 4'000'000);
  EXPECT_EQ(sources.next_of(head_of(1000, ten + 3600)), 400'000);
  EXPECT_EQ(sources.next_of(head_of(1000, ten - 60)), 4'060'000);
  EXPECT_EQ(sources.next_of(head_of(1000, ten + 2 * 3600)), 0) << "its first sample is wanted";
  EXPECT_EQ(sources.next_of(head_of(1000, {})), 4'000'000) << "the same source without a start";
  EXPECT_EQ(sources.next_of(head_of(1000, {}, "daq-2")), std::nullopt) << "another source";
  EXPECT_EQ(sources.next_of(head_of(2000, ten)), std::nullopt) << "another rate";
  EXPECT_EQ(sources.next_of(head_of(1000, ten + 0.0005)), std::nullopt) << "between two samples";
}

TEST(LiveSources, NoNumberIsSentBeforeThereIsOne)
{
  LiveSources sources(LiveInput{LiveInput::Kind::tcp, "127.0.0.1:0"});
  EXPECT_EQ(sources.next_of(head_of(1000, ten)), std::nullopt);
  sources.set_next(500);
  EXPECT_EQ(sources.next_of(head_of(1000, ten)), std::nullopt) << "no source has begun";
  sources.begin({"daq-1", 1000, ten, {{"force", "N"}}, {}, {1}}, true);
  EXPECT_EQ(sources.next_of(head_of(1000, ten)), std::nullopt) << "500 was of the source before";
}

// Programs that begin and end at once: the file of the lock goes with each that ends.
TEST(RecordLock, OneHoldsItAtATime)
{
  const std::string folder = scratch("live-lock");
  std::atomic<int> holders{0}, most{0}, held{0};
  const auto begin_and_end = [&] {
    for (int k = 0; k < 5000; ++k)
      try {
        const RecordLock lock(folder);
        const int now = ++holders;
        if (now > most)
          most = now;
        ++held;
        --holders;
      } catch (const InputError &) {
      }
  };
  std::vector<std::thread> programs;
  for (int i = 0; i < 4; ++i)
    programs.emplace_back(begin_and_end);
  for (std::thread &program : programs)
    program.join();
  EXPECT_EQ(most, 1);
  EXPECT_GT(held, 100);
}

TEST(ProcessorShare, IsTheTimeOfTheProcessorOverThatOfTheClock)
{
  ProcessorShare share;
  EXPECT_TRUE(std::isnan(share.since_last_call(10)));
  timespec begun{}, ended{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begun);
  double used = 0;
  while (used < 0.2) {
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &ended);
    used = double(ended.tv_sec - begun.tv_sec) + 1e-9 * double(ended.tv_nsec - begun.tv_nsec);
  }
  EXPECT_TRUE(near(share.since_last_call(12), used / 2,
                   within_absolute(0.01, "what the calls themselves take, of 2 s of the clock")));
}
