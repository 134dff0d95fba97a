#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand calibrate: fits the chain of a case to records and writes a folder with calibration.json, tables,
/// report.html and, unless it is refused, calibrated.toml.  With --plan it prints which unknowns a record would
/// identify, and with -o writes plan.json and report.html.
/// @return 0; 3 where the calibration is refused
/// @throws InputError  a case, a record or an option that is wrong; a folder that holds something else
int calibrate_command(const CommandLine &command);
}  // namespace mill
