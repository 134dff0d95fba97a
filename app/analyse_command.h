#pragma once
#include "app/command_line.h"
#include "twin/records/raw_record.h"

namespace mill {
/// millstand analyse: every record read, cleaned and analysed by itself; each leaves a folder with analysis.json,
/// tables and report.html.
/// @throws InputError  a record, a case or an option that is wrong; a folder that holds something else
int analyse_command(const CommandLine &command);

/// What --rate, --zone, --channel and --unit say about records.
/// @throws InputError  the option and what it needs
twin::ReadOptions read_options(const CommandLine &command);
}  // namespace mill
