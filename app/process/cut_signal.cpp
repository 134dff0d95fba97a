#include "app/process/cut_signal.h"
#include "core/process/stop.h"
#include <array>
#include <csignal>

namespace mill {
namespace {
volatile std::sig_atomic_t cut_by = 0;
constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};

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
  for (const int number : signals)
    if (std::signal(number, ask_for_cut) == SIG_IGN && number == SIGHUP)
      std::signal(number,
                  SIG_IGN);  // nohup; a job in the background begins with SIGINT ignored, and may be ended by it
}

CutSignal::~CutSignal()
{
  if (of_caller)
    return;
  for (const int number : signals)
    if (std::signal(number, SIG_DFL) == SIG_IGN && number == SIGHUP)
      std::signal(number, SIG_IGN);
}

int CutSignal::asked() const
{
  if (of_caller)
    return of_caller->load(std::memory_order_relaxed) ? SIGINT : 0;
  return cut_by;
}
}  // namespace mill
