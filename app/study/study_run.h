#pragma once
#include "app/command/command_line.h"
#include "app/study/study_folder.h"
#include <string>

namespace mill {
/// millstand study run: starts the rows that are not finished, by one of three engines, and merges what is
/// finished.
///   here      processes of this machine (--jobs, one of all threads unless said), started again after a crash
///   parallel  GNU parallel: this machine, or those of --hosts FILE by ssh
///   slurm     an array of sbatch, one element for each of --jobs; it returns once the array is submitted
/// @return 0; 128 and the number of the signal that asked for an end; 3 where an engine failed
/// @throws InputError  no study, sbatch or parallel are not installed
int study_run(const CommandLine &command);

/// The script that an engine starts, as --dry-run prints it.  Only the folder and the number of the shard pass a
/// shell.
/// @param engine  "parallel" or "slurm"
/// @param shards  number of shards; of slurm the elements of the array
/// @param program path of millstand
std::string engine_script(const Study &study, StudyEngine engine, long shards, const CommandLine &command,
                          const std::string &program);

/// Shards for so many cores: at least ten for each, each of 20 s or more, one at least.
long shards_for(const Study &study, long cores);
}  // namespace mill
