#pragma once
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace mill {
/// Calls task(i) for i = 0 .. n-1 from up to `threads` threads, the caller's among them; each i once, in no order.
/// Fewer threads than asked for do the work where the system starts no more.
/// Tasks write to places of their own, so that the outcome is the same with any number of threads.
/// An exception of a task ends the work and comes out here, the first of several.
template <class Task> void share_tasks(const long n, const int threads, const Task &task)
{
  std::atomic<long> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    for (long i = next++; i < n; i = next++)
      try {
        task(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure)
          failure = std::current_exception();
        next = n;
      }
  };
  const long wanted = std::min<long>(threads, n) - 1;
  std::vector<std::thread> others;
  others.reserve(std::size_t(std::max(0L, wanted)));
  try {
    for (long i = 0; i < wanted; ++i)
      others.emplace_back(work);
  } catch (const std::exception &) {
    // the system starts no more threads, or has no memory for them: those that run share the tasks
  }
  work();
  for (std::thread &other : others)
    other.join();
  if (failure)
    std::rethrow_exception(failure);
}
}  // namespace mill
