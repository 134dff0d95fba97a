#include "twin/live/queue/sample_queue.h"
#include <chrono>

namespace mill::live {
namespace {
constexpr std::size_t most_messages = 100'000;  // of lines without samples

std::int64_t samples_of(const Message &message)
{
  const auto *block = std::get_if<SourceBlock>(&message);
  return block ? block->value.rows() : 0;
}
}  // namespace

SampleQueue::SampleQueue(const double seconds) : seconds_(seconds) {}

// A block longer than the whole queue passes when nothing else waits.
bool SampleQueue::has_room(const Message &message) const
{
  const std::int64_t n = samples_of(message);
  if (n == 0)
    return messages_.size() < most_messages;
  return samples_ == 0 || double(samples_ + n) <= seconds_ * rate_;
}

void SampleQueue::append(Message message)
{
  if (const auto *head = std::get_if<SourceHead>(&message))
    rate_ = head->rate;
  samples_ += samples_of(message);
  messages_.push_back(std::move(message));
  filled_.notify_one();
}

bool SampleQueue::push(Message message)
{
  std::unique_lock lock(mutex_);
  room_.wait(lock, [&] { return closed_ || has_room(message); });
  if (closed_)
    return false;
  append(std::move(message));
  return true;
}

bool SampleQueue::try_push(Message &message)
{
  const std::lock_guard lock(mutex_);
  if (closed_ || !has_room(message))
    return false;
  append(std::move(message));
  return true;
}

void SampleQueue::push_or_drop(SourceBlock block)
{
  const std::lock_guard lock(mutex_);
  if (closed_)
    return;
  Message message = std::move(block);
  if (has_room(message)) {
    append(std::move(message));
    return;
  }
  const auto &lost = std::get<SourceBlock>(message);
  auto *last       = messages_.empty() ? nullptr : std::get_if<DroppedBlock>(&messages_.back());
  if (last && last->first + last->n == lost.first)
    last->n += lost.value.rows();
  else
    append(DroppedBlock{lost.first, lost.value.rows()});
}

std::optional<Message> SampleQueue::pop(const double wait)
{
  std::unique_lock lock(mutex_);
  filled_.wait_for(lock, std::chrono::duration<double>(wait), [&] { return closed_ || !messages_.empty(); });
  if (messages_.empty())
    return {};
  Message message = std::move(messages_.front());
  messages_.pop_front();
  samples_ -= samples_of(message);
  room_.notify_all();
  return message;
}

void SampleQueue::close()
{
  const std::lock_guard lock(mutex_);
  closed_ = true;
  room_.notify_all();
  filled_.notify_all();
}

bool SampleQueue::closed() const
{
  const std::lock_guard lock(mutex_);
  return closed_;
}

std::int64_t SampleQueue::samples() const
{
  const std::lock_guard lock(mutex_);
  return samples_;
}
}  // namespace mill::live
