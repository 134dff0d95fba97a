#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand study new|run|work|status|merge|report.  @return exit code  @throws as the action
int study_command(const CommandLine &command);
}  // namespace mill
