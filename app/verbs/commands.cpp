#include "app/verbs/commands.h"
#include "app/command/completion.h"
#include "app/command/linked_subjects.h"
#include "app/command/verify_options.h"
#include "app/help/topics.h"
#include "app/process/console.h"
#include "app/process/fast_blas.h"
#include "app/process/version.h"
#include "app/run/run_kind.h"
#include "app/run/run_summary.h"
#include "app/stages/stand/mass_table.h"
#include "app/trace/trace_text.h"
#include "app/verbs/checked_case.h"
#include "app/verbs/marks_command.h"
#include "app/verbs/run_command.h"
#include "app/verbs/stack_command.h"
#include "core/base/files.h"
#include "core/base/save_in_place.h"
#include "core/base/short_number.h"
#include "core/base/visible_text.h"
#include "core/case/case_sheet.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "core/process/memory.h"
#include "core/records/cache_limit.h"
#include "core/records/rows_of_chatter.h"
#include "report/compare/comparison.h"
#include "report/front/html.h"
#include "report/results/names.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
std::string manifest_path;

void print_table(const Results &results)
{
  using console::print;
  print(fmt::format("{:<34} {:>22} {:>9}  {}\n", "result", "value", "error", "at"));
  for (const auto &[name, p] : results.values) {
    if (report::is_of_one_model(name) || is_made_by(row::chatter::of_variants, name))
      continue;  // side by side in the report
    print(fmt::format("{:<34} {:>22} {:>9}  {}\n", visible(name, true), engineering(p),
                      std::isnan(p.error_estimate) ? "-" : percent_text(p.error_estimate),
                      visible(p.at.text(), true)));
  }
  for (const Warning &warning : results.warnings)
    print("warning: " + visible(text_of(warning), true) + "\n");
}

int check_case(const CommandLine &command)
{
  const CheckedCase checked = checked_case(command);
  const Case &the_case      = checked.the_case;
  console::print(
      fmt::format("{}: no errors ({} \"{}\")\n", command.target, the_case.kind, visible(the_case.title, true)));
  for (const Warning &remark : remarks_of(checked)) {
    Problem problem = problem_of(remark);
    problem.message = visible(problem.message, true);
    console::print(render(problem, "warning") + "\n");
  }
  for (const std::string &sentence : facts_of(checked))
    console::print(visible(sentence, true) + "\n");
  return 0;
}

int run_chain(const CommandLine &command)
{
  const CheckedCase checked = checked_case(command);
  const Case &the_case      = checked.the_case;
  manifest_path             = folder_of_run(command, the_case) + "/run.json";
  console::ProgressBar bar(run_kind(the_case).stages(the_case), command.quiet);
  Progress shown;
  shown.step            = [&](const std::string &stage, const double fraction) { bar.show(stage, fraction); };
  const FinishedRun run = [&] {
    try {
      return carry_out_run(command, checked, shown);
    } catch (const SolverError &) {
      bar.finish();
      throw;
    }
  }();
  bar.finish();
  const std::string page = run.folder + "/report.html";
  if (command.verb == Verb::run && !command.quiet && !command.verbose) {
    console::print(run_summary(run.results, the_case.name, run.limits, page));
  } else if (!command.quiet) {
    print_table(run.results);
    if (!run.limits.empty())
      console::print("\n" + run.limits + "\n");
    if (command.verb == Verb::masses)
      console::print("\n" + mass_table(run.results));
    console::print("report: " + page + "\n");
  }
  return 0;
}

int write_template(const CommandLine &command)
{
  const std::string text = command.from.empty()
                               ? template_of(command.target)
                               : template_from_sheet(command.target, command.from, read_text(command.from));
  if (command.output.empty()) {
    console::print(text);
    return 0;
  }
  if (fs::exists(command.output) && !command.force_overwrite)
    throw InputError("the file " + command.output + " exists; choose another with -o, or give --force-overwrite");
  save_in_place(command.output, text);
  return 0;
}

// The page of the stored results; a run that was interrupted while publishing is completed first.
int write_report(const std::string &directory)
{
  {
    const FolderLock alone(directory);  // a run that ends now publishes before or after
    finish_publishing(directory);
    write_atomically(directory + "/report.html", report::html_report(directory));
  }
  console::print("report: " + directory + "/report.html\n");
  return 0;
}

// A page of an earlier comparison may be replaced, any other file is kept.
void refuse_foreign_file(const std::string &file)
{
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored)))
    return;
  const auto text = text_if_readable(file);
  if (!text || !report::is_comparison_page(*text))
    throw InputError("the file " + file +
                     " exists and is not a comparison that 'millstand report' wrote; choose another name with -o");
}

// Compares runs; the page is written to the first folder unless -o names a file.
int write_comparison(const CommandLine &command)
{
  const std::string file = command.output.empty() ? command.target + "/comparison.html" : command.output;
  refuse_foreign_file(file);
  std::vector<std::string> directories{command.target};
  directories.insert(directories.end(), command.names.begin(), command.names.end());
  for (const std::string &directory : directories) {
    const FolderLock alone(directory);
    finish_publishing(directory);
  }
  write_atomically(file, report::comparison_of(directories));
  console::print("comparison: " + file + "\n");
  return 0;
}
}  // namespace

std::string current_manifest()
{
  std::error_code ignored;
  return fs::exists(manifest_path, ignored) ? manifest_path : "";
}

int carry_out(const CommandLine &command)
{
  console::begin_progress();
  console::progress_line_every(command.progress_step);
  if (!command.memory.empty())
    set_memory_limit(bytes_of_size("--memory", command.memory));
  if (command.verb == Verb::new_case)
    return write_template(command);
  if (command.verb == Verb::check)
    return check_case(command);
  if (command.verb == Verb::trace) {
    require_linked(read_case(command.target, command.sets), command);
    const TraceOptions options{command.target, command.key, command.sets, command.output, command.full};
    console::print(trace_text(trace(options), !command.quiet));
    return 0;
  }
  if (command.verb == Verb::verify) {
    use_fast_blas(command.arguments);
    return verify_command({command.names, command.list, command.quiet, command.markdown, command.threads});
  }
  if (command.verb == Verb::completion) {
    console::print(completion_script(command.target, command.verbs));
    return 0;
  }
  if (command.verb == Verb::help) {
    std::string topic;
    for (const std::string &word : command.names)
      topic += (topic.empty() ? "" : " ") + word;
    console::print(command.manual_page ? manual_page(command.verbs, command.summary, version())
                                       : help::topic_text(topic, command.verbs));
    return 0;
  }
  if (command.verb == Verb::schema) {
    console::print(case_schema());
    return 0;
  }
  if (is_of_subjects(command))
    return carry_out_subject(command);
  if (command.verb == Verb::stack)
    return stack_command(command, checked_case(command).the_case);
  if (command.verb == Verb::marks)
    return marks_command(command, checked_case(command).the_case);
  if (command.verb == Verb::report)
    return command.names.empty() ? write_report(command.target) : write_comparison(command);
  return run_chain(command);
}
}  // namespace mill
