#include "core/process/stop.h"

namespace mill {
namespace {
thread_local const std::atomic<bool> *stop_of_thread = nullptr;
}  // namespace

Stoppable::Stoppable(const std::atomic<bool> *asked) : before(stop_of_thread)
{
  stop_of_thread = asked;
}

Stoppable::~Stoppable()
{
  stop_of_thread = before;
}

const std::atomic<bool> *Stoppable::current()
{
  return stop_of_thread;
}

void stop_if_asked()
{
  if (stop_of_thread && stop_of_thread->load(std::memory_order_relaxed))
    throw Stopped();
}
}  // namespace mill
