#pragma once
#include "twin/live/queue/messages.h"
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace mill::live {
/// Between the readers of sources and the engine: some seconds of samples, no more.
class SampleQueue {
public:
  /// @param seconds  of samples at the rate of the last head
  explicit SampleQueue(double seconds = 2);

  /// Waits for room (back-pressure).  False: the queue was closed.
  bool push(Message message);
  /// Takes it when there is room now; false when it is full or closed.
  bool try_push(Message &message);
  /// A block that cannot wait: where there is no room it is dropped, and what was dropped keeps its place in the
  /// order.
  void push_or_drop(SourceBlock block);
  /// The next message; nothing after `wait` (s).
  std::optional<Message> pop(double wait);
  /// Nothing is taken any more; whoever waits goes on.
  void close();
  bool closed() const;
  std::int64_t samples() const;  ///< that wait

private:
  bool has_room(const Message &message) const;
  void append(Message message);

  mutable std::mutex mutex_;
  std::condition_variable room_, filled_;
  std::deque<Message> messages_;
  double seconds_, rate_ = 0;
  std::int64_t samples_ = 0;
  bool closed_          = false;
};
}  // namespace mill::live
