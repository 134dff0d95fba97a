#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand analyse: every record is read, cleaned and analysed separately; each leaves a folder with
/// analysis.json, tables and report.html.
/// @throws InputError  a record, a case or an option that is wrong; a folder that holds something else
int analyse_command(const CommandLine &command);
}  // namespace mill
