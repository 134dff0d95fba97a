#include "core/base/errors.h"
#include "core/process/parallel.h"
#include "core/process/stage_work.h"
#include "tests/support/address_space.h"
#include <gtest/gtest.h>
#include <unistd.h>

using mill::share_tasks;

TEST(ShareTasks, EveryTaskIsDoneOnceWithAnyNumberOfThreads)
{
  for (const int threads : {-1, 1, 2, 7, 200}) {
    std::vector<int> calls(100, 0);
    share_tasks(long(calls.size()), threads, [&](const long i) { ++calls[std::size_t(i)]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << threads;
  }
  share_tasks(0, 4, [](long) { FAIL() << "there is no task"; });
}

TEST(ShareTasks, AnErrorOfATaskReachesTheCaller)
{
  for (const int threads : {1, 4})
    EXPECT_THROW(share_tasks(50, threads,
                             [](const long i) {
                               if (i == 20)
                                 throw mill::InputError("task 20");
                             }),
                 mill::InputError);
}

// A thread needs 8 MB of address space for its stack; without room for one the caller does the work alone.
TEST(ShareTasks, WithoutMemoryForThreadsTheWorkIsStillDone)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer maps terabytes of address space";
#endif
#ifdef __has_feature
#if __has_feature(thread_sanitizer)
  GTEST_SKIP() << "the sanitizer ends the program where it gets no memory of its own";
#endif
#endif
  std::vector<int> calls(1000, 0);
  {
    const AddressSpaceLimit tight(mapped_address_space() + (4u << 20));
    ASSERT_TRUE(tight.set);
    share_tasks(long(calls.size()), 64, [&](const long i) { ++calls[std::size_t(i)]; });
  }
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
}

TEST(ShareTasks, NestedSharedWorkEnds)
{
  std::vector<std::vector<int>> calls(20, std::vector<int>(20, 0));
  share_tasks(20, 4, [&](const long i) {
    share_tasks(20, 4, [&](const long j) { ++calls[std::size_t(i)][std::size_t(j)]; });
  });
  EXPECT_EQ(calls, std::vector<std::vector<int>>(20, std::vector<int>(20, 1)));
}

namespace {
void spend(const double seconds)
{
  const mill::StageWork work;
  while (work.processor_seconds() < seconds) {
  }
}
}  // namespace

TEST(StageWork, ThreadsThatShareWorkAreIncludedOnce)
{
  const mill::StageWork stage;
  share_tasks(8, 2, [](long) { spend(0.01); });
  EXPECT_GE(stage.processor_seconds(), 0.08);
  EXPECT_LE(stage.processor_seconds(), 0.16);
}

TEST(StageWork, FactorisationsBelongToTheInnermostStageAndEqualOnesAreCounted)
{
  mill::StageWork outer;
  mill::StageWork::add({10, 100, 1000});
  {
    mill::StageWork inner;
    share_tasks(4, 2, [](const long i) { mill::StageWork::add({i < 2 ? 20 : 30, 5, 7}); });
    const auto all = inner.factorisations();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].order, 30);
    EXPECT_EQ(all[0].times, 2);
  }
  ASSERT_EQ(outer.factorisations().size(), 1u);
  EXPECT_EQ(outer.factorisations()[0].order, 10);
}
