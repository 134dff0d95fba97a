#include "core/process/parallel.h"
#include "core/process/stage_work.h"
#include "core/process/stop.h"
#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <mutex>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>
#include <vector>

namespace mill {
namespace {
// oneTBB does not survive a thread that the system refuses to start, so as many are started once for trial.
bool can_start(const int n)
{
  static std::atomic<int> known{0};
  if (known >= n)
    return true;
  std::promise<void> all_started;
  const std::shared_future<void> release = all_started.get_future().share();
  std::vector<std::thread> others;
  others.reserve(std::size_t(n));
  try {
    while (int(others.size()) < n)
      others.emplace_back([release] { release.wait(); });
  } catch (const std::exception &) {
    // so many and no more
  }
  all_started.set_value();
  for (std::thread &other : others)
    other.join();
  if (int(others.size()) == n)
    known = n;
  return int(others.size()) == n;
}

// Tasks still to do, and the first thing that went wrong.
class TaskList {
public:
  TaskList(const long n, const std::function<void(long)> &one) : count(n), task(one) {}
  // oneTBB orders hand-over and end as well, but in a library that the thread sanitizer does not see.
  void hand_over()
  {
    handed_over.store(true, std::memory_order_release);
  }
  void work()
  {
    handed_over.load(std::memory_order_acquire);
    work_as_caller();
    ended.fetch_add(1, std::memory_order_release);
  }
  void rethrow() const
  {
    ended.load(std::memory_order_acquire);
    if (failure)
      std::rethrow_exception(failure);
  }

private:
  void work_as_caller()
  {
    const StageWork::Share on_behalf(stage);
    const Stoppable as_caller(stop);
    for (long i = next++; i < count; i = next++)
      try {
        stop_if_asked();
        tbb::this_task_arena::isolate([&] { task(i); });
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure)
          failure = std::current_exception();
        next = count;
      }
  }

  const long count;
  const std::function<void(long)> &task;
  StageWork *const stage              = StageWork::current();
  const std::atomic<bool> *const stop = Stoppable::current();
  std::atomic<long> next{0};
  std::atomic<bool> handed_over{false};
  std::atomic<int> ended{0};
  std::exception_ptr failure;
  std::mutex failing;
};
}  // namespace

void share_tasks(const long n, const int threads, const std::function<void(long)> &task)
{
  TaskList tasks(n, task);
  const int workers = std::min({long(threads), n, long(tbb::this_task_arena::max_concurrency())});
  if (workers <= 1 || !can_start(workers - 1))
    tasks.work();
  else {
    tasks.hand_over();
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          0, workers, [&](int) { tasks.work(); }, tbb::simple_partitioner());
    });
  }
  tasks.rethrow();
}

std::mutex &rand_access()
{
  static std::mutex access;
  return access;
}
}  // namespace mill
