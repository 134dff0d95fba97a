#pragma once
#include "app/command/command_line.h"

namespace mill {
struct Case;

/// millstand simulate --stream: drives the model of one pass with a force record of any length.  The record is
/// read twice, in blocks; response.csv, spectrum.csv and summary.json appear together at the end, or at SIGINT and
/// SIGTERM with what was reached.  Returns the exit code: 0, or 128 and the number of the signal. Memory: some 200
/// MB for any length.  theory.md 7.6
/// @throws InputError  no --force; a kind without such a model; a record that cannot be read; a folder that
///         is not a result of this program
int stream_command(const CommandLine &command, const Case &the_case);
}  // namespace mill
