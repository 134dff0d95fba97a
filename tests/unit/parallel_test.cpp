#include "core/errors.h"
#include "core/parallel.h"
#include <gtest/gtest.h>

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
