#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand studio: serves the page of a case until SIGINT or SIGTERM.  @return exit code
/// @throws InputError, SystemError  case, journal or address cannot be used
int studio_command(const CommandLine &command);
}  // namespace mill
