#include "app/twin/twin_command.h"
#include "app/checked_case.h"
#include "app/twin/advise_command.h"
#include "app/twin/analyse_command.h"
#include "app/twin/calibrate/calibrate_command.h"
#include "app/twin/live/live_command.h"

namespace mill {
int twin_command(const CommandLine &command)
{
  if (command.verb == "analyse")
    return analyse_command(command);
  if (command.verb == "calibrate")
    return calibrate_command(command);
  if (command.verb == "advise")
    return advise_command(command, checked_case(command).the_case);
  return live_command(command, read_case(command.target, command.sets));
}
}  // namespace mill
