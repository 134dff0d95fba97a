#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace mill::live {
/// Work on the disk that the engine does not wait for: one task after the other in a thread of its own.  What a
/// task throws is its own affair: tasks catch.
class Background {
public:
  Background();
  ~Background();  ///< does what was asked for, then ends
  Background(const Background &)            = delete;
  Background &operator=(const Background &) = delete;
  void run(std::function<void()> task);
  std::size_t waiting() const;

private:
  mutable std::mutex mutex_;
  std::condition_variable asked_;
  std::deque<std::function<void()>> tasks_;
  bool ends_ = false;
  std::thread thread_;
};
}  // namespace mill::live
