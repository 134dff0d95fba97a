#pragma once
#include "app/run/asked_speeds.h"
#include "app/verbs/checked_case.h"
#include "core/process/progress.h"
#include "core/records/csv.h"
#include "core/records/results.h"
#include <map>
#include <string>

namespace mill {
struct CommandLine;

/// What a run has in memory at its end; all of it is in its folder too.
struct FinishedRun {
  Results results;
  std::map<std::string, Table> tables;  ///< curves and responses, by their path in the folder without ending
  std::string limits;                   ///< sentences of the stages, a line each: critical speeds
  std::string folder;                   ///< where it is published
  std::vector<AskedSpeed> asked;        ///< critical speeds that were searched
};

/// Folder of a run: that of the command, or out/ and the name of the case.
std::string folder_of_run(const CommandLine &command, const Case &the_case);

/// Carries out run, stiffness, masses, modes, chatter or simulate of a case and publishes its folder with the
/// page. Uses of the command: verb, target, output, force, log, cache, fresh, threads, force_overwrite, verbose.
/// @param shown  what the caller shows of the progress; may be empty
/// @throws InputError   the kind does not serve the verb; the folder; the stages
/// @throws SolverError  a stage failed, or no memory is left: the folder then holds what is good
FinishedRun carry_out_run(const CommandLine &command, const CheckedCase &checked, const Progress &shown);
}  // namespace mill
