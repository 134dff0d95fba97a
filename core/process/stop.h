#pragma once
#include <atomic>

namespace mill {
/// Thrown where work ends because its caller has asked for it.  Not an error: nothing catches it as one.
struct Stopped {};

/// While it lives, work of this thread, and of the threads that share it (share_tasks), ends where `asked` has
/// become true.  Without it work always goes to its end.
class Stoppable {
public:
  explicit Stoppable(const std::atomic<bool> *asked);
  ~Stoppable();
  Stoppable(const Stoppable &)            = delete;
  Stoppable &operator=(const Stoppable &) = delete;

  /// What this thread looks at; nullptr: nothing.
  static const std::atomic<bool> *current();

private:
  const std::atomic<bool> *const before;
};

/// Called between two pieces of long work.  @throws Stopped
void stop_if_asked();
}  // namespace mill
