#pragma once
#include "twin/live/queue/sample_queue.h"
#include <atomic>
#include <exception>
#include <functional>
#include <thread>

namespace mill::live {
/// A reader in a thread of its own.  Its end is the end of the source.
class SourceThread {
public:
  /// @param read  returns when it has nothing more, or when `stop` is set or the queue closed
  SourceThread(SampleQueue &queue, std::function<void(const std::atomic<bool> &stop)> read)
      : queue_(queue), thread_([this, read = std::move(read)] {
          try {
            read(stop_);
            queue_.push(SourceEnd{"the source has ended"});
          } catch (...) {
            failure_    = std::current_exception();
            has_failed_ = true;
            queue_.push(SourceEnd{"the source was refused"});
          }
        })
  {
  }
  ~SourceThread()
  {
    stop_ = true;
    queue_.close();
    thread_.join();
  }
  SourceThread(const SourceThread &)            = delete;
  SourceThread &operator=(const SourceThread &) = delete;
  /// While the reader runs as well.  @throws what the reader threw up to now
  void rethrow() const
  {
    if (has_failed_)
      std::rethrow_exception(failure_);
  }

private:
  SampleQueue &queue_;
  std::atomic<bool> stop_{false};
  std::exception_ptr failure_;  // written once, before has_failed_ is set
  std::atomic<bool> has_failed_{false};
  std::thread thread_;
};
}  // namespace mill::live
