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
            failed_ = std::current_exception();
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
  /// After the end.  @throws what the reader threw
  void rethrow() const
  {
    if (failed_)
      std::rethrow_exception(failed_);
  }

private:
  SampleQueue &queue_;
  std::atomic<bool> stop_{false};
  std::exception_ptr failed_;
  std::thread thread_;
};
}  // namespace mill::live
