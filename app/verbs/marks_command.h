#pragma once
#include "app/command/command_line.h"

namespace mill {
struct Case;

/// millstand marks: the spacing laid around every roll, against what happens in a turn and against the modes;
/// table on the console, results, record and page in a folder of its own.  Modes are those of the last run of this
/// very case, otherwise of closed forms; the results state which.  theory.md 40
/// @return exit code
/// @throws InputError  a flag that is not a quantity of its kind, a case in which nothing turns
/// Cost: below a second; nothing is meshed.
int marks_command(const CommandLine &command, const Case &the_case);
}  // namespace mill
