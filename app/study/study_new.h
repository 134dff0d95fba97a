#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand study new: draws or lists the rows, checks each as by --set, computes the base case and writes
/// study.toml and study.db.  Nothing else is computed.
/// @throws InputError  case, key, distribution, method, name of a result, a row (which one), the folder
/// Cost: reading the case once for each row, side by side; the base case.
int study_new(const CommandLine &command);
}  // namespace mill
