#pragma once
#include "app/command_line.h"

// Verbs that hold a stand against its records: a program of its own, millstand-twin, since who runs a stand does
// not need them.
namespace mill {
/// Whether a folder holds an analysis, a calibration or advice, and no run.
bool is_folder_of_twin(const std::string &directory);

/// analyse, calibrate, advise, live, and report of a folder that one of them wrote.
bool is_of_twin(const CommandLine &command);

/// Carries out a verb of the twin; in the other programs millstand-twin takes over.  Returns the exit code.
/// @throws InputError, SolverError  of the verb; InputError  millstand-twin is not there
int twin_command(const CommandLine &command);
}  // namespace mill
