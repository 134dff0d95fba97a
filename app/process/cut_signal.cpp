#include "app/process/cut_signal.h"
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

CutSignal::CutSignal()
{
  cut_by = 0;
  for (const int number : signals)
    if (std::signal(number, ask_for_cut) == SIG_IGN)
      std::signal(number, SIG_IGN);  // nohup, or a job in the background
}

CutSignal::~CutSignal()
{
  for (const int number : signals)
    if (std::signal(number, SIG_DFL) == SIG_IGN)
      std::signal(number, SIG_IGN);
}

int CutSignal::asked() const
{
  return cut_by;
}
}  // namespace mill
