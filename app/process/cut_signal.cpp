#include "app/process/cut_signal.h"
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

CutSignal::CutSignal()
{
  cut_by = 0;
  std::signal(SIGINT, ask_for_cut);
  std::signal(SIGTERM, ask_for_cut);
}

CutSignal::~CutSignal()
{
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

int CutSignal::asked() const
{
  return cut_by;
}
}  // namespace mill
