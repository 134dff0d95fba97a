#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand study status: rows finished, failed, open; the files and what a worker is at.
int study_status(const CommandLine &command);

/// millstand study merge: finished.db from the files of all workers, and results.csv in the order of the design:
/// the same bytes whatever computed the rows.
int study_merge(const CommandLine &command);

/// millstand study report: merges, then statistics, sensitivities, report.json and the page.
/// @throws InputError  more than 5 % of the rows failed, without --allow-failed
int study_report(const CommandLine &command);
}  // namespace mill
