#pragma once
#include "app/command/command_line.h"
#include "app/process/cut_signal.h"
#include "app/study/row_watch.h"
#include <sys/types.h>

namespace mill {
/// `study work` for each of as many shards, side by side on this machine.  A shard that a crash ended is started
/// again, since its second crash is marked.
/// @return exit code; 128 and its number: a signal asked for an end, after every worker has kept what was finished
int run_workers_here(const Study &study, const CommandLine &command, long jobs, const CutSignal &signal,
                     RowWatch &watch);

/// Waits for a program, which gets SIGTERM once when an end is asked for.
/// @return its exit code, or 128 and the number of the signal that ended it
int wait_or_end(pid_t process, const CutSignal &signal, RowWatch &watch);
}  // namespace mill
