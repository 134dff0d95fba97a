#include "core/errors.h"
#include "core/parallel.h"
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
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
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit tight{rlim_t(pages * sysconf(_SC_PAGESIZE)) + (4u << 20), before.rlim_max};
  std::vector<int> calls(1000, 0);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  share_tasks(long(calls.size()), 64, [&](const long i) { ++calls[std::size_t(i)]; });
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
}
