#include "app/twin/live/live_command.h"
#include "app/twin/live/live_run.h"
#include "core/model/case.h"

namespace mill {
int live_command(const CommandLine &command, const Case &the_case)
{
  LiveRun run(command, the_case);
  return run.until_the_end();
}
}  // namespace mill
