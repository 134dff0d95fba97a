#pragma once
#include "twin/live/page/page_command.h"
#include <mutex>
#include <utility>
#include <vector>

namespace mill::live {
/// From the threads that receive commands to the engine, which takes them between two blocks.
class CommandQueue {
public:
  /// False when too many wait.
  bool push(PageCommand command)
  {
    const std::lock_guard lock(mutex_);
    if (commands_.size() >= 1000)
      return false;
    commands_.push_back(std::move(command));
    return true;
  }
  std::vector<PageCommand> take()
  {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }

private:
  std::mutex mutex_;
  std::vector<PageCommand> commands_;
};
}  // namespace mill::live
