#include "app/twin/live/live_command.h"
#include "app/process/console.h"
#include "app/twin/live/live_run.h"
#include "core/base/errors.h"
#include "core/base/visible_text.h"
#include "core/model/case.h"
#include <filesystem>

namespace mill {
int live_command(const CommandLine &command, const Case &the_case)
{
  std::error_code not_there;
  bool old_response_stays =
      command.force_overwrite && std::filesystem::is_regular_file(command.live.response, not_there);
  try {
    LiveRun run(command, the_case);
    try {
      return run.until_the_end();
    } catch (const InputError &) {
      old_response_stays = old_response_stays && run.leaves_old_response();
      throw;
    }
  } catch (const InputError &) {
    if (old_response_stays)
      console::say(visible(command.live.response, true) + " is unchanged\n");
    throw;
  }
}
}  // namespace mill
