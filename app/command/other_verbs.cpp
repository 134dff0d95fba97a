#include "app/command/command_line.h"
#include "app/command/common_options.h"
#include "app/command/verb_declarations.h"
#include <CLI/CLI.hpp>

namespace mill {
namespace {
void add_verify(CLI::App &app, CommandLine &c)
{
  auto *verify = app.add_subcommand("verify", "run the verification manual: result, reference, tolerance");
  verify->add_option("NAME", c.names, "cases to run (default: all)");
  verify->add_flag("--list", c.list, "list the cases, run nothing");
  verify->add_option("--markdown", c.markdown, "write the manual as a page, after running all cases");
  verify->add_flag("-q,--quiet", c.quiet, "no progress, no table of a case that passes");
  add_threads(verify, c);
}

void add_report(CLI::App &app, CommandLine &c)
{
  auto *report =
      app.add_subcommand("report", "write DIR/report.html again from the stored results, or compare runs");
  report->add_option("DIR", c.target, "folder of a run")->required();
  report->add_option("MORE", c.names, "further runs or analyses: what differs is written to DIR/comparison.html");
  report->add_option("-o", c.output, "file of the comparison");
}

void add_reading(CLI::App &app, CommandLine &c)
{
  auto *help =
      app.add_subcommand("help", "explain a task, a verb, a term, a result or a key; without a topic list them");
  help->add_option("TOPIC", c.names, "chatter-heard, sweep, \"gap mode\", K3, work_roll.crown");
  help->add_flag("--manual-page", c.manual_page, "print the manual page of all verbs, for man");
  app.add_subcommand("schema", "print the JSON Schema of the case file");
  auto *completion = app.add_subcommand("completion", "print the completion of a shell");
  completion->add_option("SHELL", c.target, "bash, fish or zsh")->required();
}
}  // namespace

void add_other_verbs(CLI::App &app, CommandLine &c)
{
  add_verify(app, c);
  add_report(app, c);
  add_reading(app, c);
}
}  // namespace mill
