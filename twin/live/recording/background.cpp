#include "twin/live/recording/background.h"

namespace mill::live {
Background::Background()
    : thread_([this] {
        std::unique_lock lock(mutex_);
        while (true) {
          asked_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
          if (tasks_.empty())
            return;
          const auto task = std::move(tasks_.front());
          tasks_.pop_front();
          lock.unlock();
          task();
          lock.lock();
        }
      })
{
}

Background::~Background()
{
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  asked_.notify_all();
  thread_.join();
}

void Background::run(std::function<void()> task)
{
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  asked_.notify_all();
}

std::size_t Background::waiting() const
{
  const std::lock_guard lock(mutex_);
  return tasks_.size();
}
}  // namespace mill::live
