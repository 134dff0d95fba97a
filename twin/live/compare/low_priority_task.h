#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <thread>

namespace mill::live {
/// Lowers the priority of the calling thread to the least the system has (nice 19).
void lower_priority();

/// One piece of work at a time in a thread of its own and of lowest priority, so that what must keep pace does.
template <class Result> class LowPriorityTask {
public:
  LowPriorityTask() = default;
  ~LowPriorityTask()
  {
    if (thread.joinable())
      thread.join();
  }
  LowPriorityTask(const LowPriorityTask &)            = delete;
  LowPriorityTask &operator=(const LowPriorityTask &) = delete;

  bool busy() const
  {
    return thread.joinable();
  }
  /// @param work  must not throw; false: still busy with the last one, which goes on
  bool start(std::function<Result()> work)
  {
    if (busy())
      return false;
    done   = false;
    thread = std::thread([this, work = std::move(work)] {
      lower_priority();
      result = work();
      done   = true;
    });
    return true;
  }
  /// The result, once, when it is there.
  std::optional<Result> finished()
  {
    if (!busy() || !done)
      return {};
    thread.join();
    return std::move(result);
  }
  /// Waits for it.  Nothing where nothing was started.
  std::optional<Result> wait()
  {
    if (!busy())
      return {};
    thread.join();
    return std::move(result);
  }

private:
  std::thread thread;
  std::atomic<bool> done{false};
  std::optional<Result> result;
};
}  // namespace mill::live
