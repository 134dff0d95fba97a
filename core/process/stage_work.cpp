#include "core/process/stage_work.h"
#include <ctime>

namespace mill {
namespace {
thread_local StageWork *stage_of_thread = nullptr;

double thread_seconds()
{
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}
}  // namespace

StageWork::StageWork() : outer(stage_of_thread), start(thread_seconds())
{
  stage_of_thread = this;
}

StageWork::~StageWork()
{
  stage_of_thread = outer;
  if (!outer)
    return;
  const std::lock_guard lock(outer->access);
  outer->shared += shared;  // the outer stage includes the work of this thread in any case
}

double StageWork::processor_seconds() const
{
  const std::lock_guard lock(access);
  return thread_seconds() - start + shared;
}

std::vector<Factorisation> StageWork::factorisations() const
{
  const std::lock_guard lock(access);
  std::vector<Factorisation> out;
  for (auto f = factors.rbegin(); f != factors.rend(); ++f)
    out.push_back({std::get<0>(f->first), std::get<1>(f->first), std::get<2>(f->first), f->second});
  return out;
}

StageWork *StageWork::current()
{
  return stage_of_thread;
}

void StageWork::add(const Factorisation &f)
{
  if (!stage_of_thread)
    return;
  const std::lock_guard lock(stage_of_thread->access);
  stage_of_thread->factors[{f.order, f.nonzeros, f.flops}] += f.times;
}

// A thread that shares its own work is already included.
StageWork::Share::Share(StageWork *work) : stage(work), before(stage_of_thread), start(thread_seconds())
{
  stage_of_thread = stage;
}

StageWork::Share::~Share()
{
  stage_of_thread = before;
  if (!stage || stage == before)
    return;
  const std::lock_guard lock(stage->access);
  stage->shared += thread_seconds() - start;
}
}  // namespace mill
