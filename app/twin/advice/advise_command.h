#pragma once

namespace mill {
struct CommandLine;
struct Case;

/// millstand advise: what would lower the vibration of the stand of a case, into a folder with advice.json,
/// advice.csv, tables and report.html.
/// @throws InputError  a kind without advice, options, records; a folder that holds something else
int advise_command(const CommandLine &command, const Case &the_case);
}  // namespace mill
