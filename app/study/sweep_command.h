#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand sweep: every combination of the values of some keys, computed in this process; results.csv,
/// sweep.json and a page with curves.  Every row is checked as by --set before the first is computed; a row that a
/// solver refuses has its sentence in the table.
/// @return exit code: 3 where no row has results
/// @throws InputError  the case, a key, a value, a row (which one), a name of a result
/// Cost: that of the rows; what their roll geometry, contacts and bearings share comes from the cache.
int sweep_command(const CommandLine &command);
}  // namespace mill
