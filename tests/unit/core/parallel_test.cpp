#include "core/case/errors.h"
#include "core/process/parallel.h"
#include "tests/support/address_space.h"
#include <gtest/gtest.h>
#include <unistd.h>

using mill::share_tasks;

TEST(ShareTasks, EveryTaskOnceWithAnyNumberOfThreads)
{
  for (const int threads : {-1, 1, 2, 7, 200}) {
    std::vector<int> calls(100, 0);
    share_tasks(long(calls.size()), threads, [&](const long i) { ++calls[std::size_t(i)]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << threads;
  }
  share_tasks(0, 4, [](long) { FAIL() << "there is no task"; });
}

TEST(ShareTasks, AnErrorOfATaskComesOut)
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
TEST(ShareTasks, WithoutRoomForThreadsTheWorkIsDoneAllTheSame)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer maps terabytes of address space";
#endif
  std::vector<int> calls(1000, 0);
  {
    const AddressSpaceLimit tight(mapped_address_space() + (4u << 20));
    ASSERT_TRUE(tight.set);
    share_tasks(long(calls.size()), 64, [&](const long i) { ++calls[std::size_t(i)]; });
  }
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
}
