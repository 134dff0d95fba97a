#include "app/studio/studio_command.h"
#include "app/process/console.h"
#include "app/process/cut_signal.h"
#include "app/studio/studio.h"
#include <chrono>
#include <thread>

namespace mill {
int studio_command(const CommandLine &command)
{
  const CutSignal signal;
  const studio::Studio studio(command);
  console::print("page:   " + studio.url() + "\n");
  console::flush();
  if (!studio.notice().empty())
    console::say(studio.notice() + "\n");
  while (!signal.asked())
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return 0;
}
}  // namespace mill
