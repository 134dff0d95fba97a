#include "app/process/cut_signal.h"
#include "core/process/stop.h"
#include <csignal>

namespace mill {
namespace {
volatile std::sig_atomic_t cut_by = 0;

void ask_for_cut(const int number)
{
  cut_by = number;
  std::signal(number, SIG_DFL);
}
}  // namespace

CutSignal::CutSignal() : of_caller(Stoppable::current())
{
  if (of_caller)
    return;
  cut_by = 0;
  std::signal(SIGINT, ask_for_cut);
  std::signal(SIGTERM, ask_for_cut);
}

CutSignal::~CutSignal()
{
  if (of_caller)
    return;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

int CutSignal::asked() const
{
  if (of_caller)
    return of_caller->load(std::memory_order_relaxed) ? SIGINT : 0;
  return cut_by;
}
}  // namespace mill
