#pragma once

namespace CLI {
class App;
}

// Verbs with their options, in the order of --help.
namespace mill {
struct CommandLine;

void add_case_verbs(CLI::App &app, CommandLine &c);    ///< new, check, run .. simulate, export
void add_record_verbs(CLI::App &app, CommandLine &c);  ///< marks, analyse, calibrate, advise, live
void add_table_verbs(CLI::App &app, CommandLine &c);   ///< studio, sweep, study, stack, trace
void add_other_verbs(CLI::App &app, CommandLine &c);   ///< verify, report, help, schema, completion
}  // namespace mill
