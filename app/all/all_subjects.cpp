#include "app/chatter/chatter_stage.h"
#include "app/chatter/stack_chatter.h"
#include "app/command/linked_subjects.h"
#include "app/export/export_command.h"
#include "app/export/stream_command.h"
#include "app/process/console.h"
#include "app/run/run_kind.h"
#include "app/studio/studio_command.h"
#include "app/study/study_command.h"
#include "app/study/sweep_command.h"
#include "app/twin/advice/advise_command.h"
#include "app/twin/analyse/analyse_command.h"
#include "app/twin/calibrate/calibrate_command.h"
#include "app/twin/live/live_command.h"
#include "app/verbs/checked_case.h"
#include "core/base/files.h"
#include "report/study/sweep_page.h"
#include "report/twin/advice/advice_page.h"
#include "report/twin/analysis/analysis_comparison.h"
#include "report/twin/analysis/analysis_page.h"
#include "report/twin/calibration/calibration_page.h"
#include "report/twin/calibration/plan_page.h"
#include <filesystem>

// millstand-all: every subject.
namespace mill {
namespace {
// The page again, from what is stored.
int write_page(const std::string &directory)
{
  const auto holds = [&](const char *file) { return std::filesystem::exists(directory + "/" + file); };
  write_atomically(directory + "/report.html", holds("calibration.json") ? report::calibration_page(directory)
                                               : holds("plan.json")      ? report::plan_page(directory)
                                               : holds("analysis.json")  ? report::analysis_page(directory)
                                               : holds("sweep.json")     ? report::sweep_page(directory)
                                                                         : report::advice_page(directory));
  console::print("report: " + directory + "/report.html\n");
  return 0;
}

// Analyses of one mill, compared; the page is in the first folder unless -o names a file.
int write_analysis_comparison(const CommandLine &command)
{
  std::vector<std::string> directories{command.target};
  directories.insert(directories.end(), command.names.begin(), command.names.end());
  for (const std::string &directory : directories)
    if (!std::filesystem::exists(directory + "/analysis.json"))
      throw InputError("the folder " + directory +
                       " holds no analysis.json; analyses are compared with analyses only");
  const std::string file = command.output.empty() ? command.target + "/comparison.html" : command.output;
  write_atomically(file, report::analysis_comparison(directories));
  console::print("comparison: " + file + "\n");
  return 0;
}

int subject_command(const CommandLine &command)
{
  if (command.verb == Verb::analyse)
    return analyse_command(command);
  if (command.verb == Verb::calibrate)
    return calibrate_command(command);
  if (command.verb == Verb::advise)
    return advise_command(command, checked_case(command).the_case);
  if (command.verb == Verb::report)
    return command.names.empty() ? write_page(command.target) : write_analysis_comparison(command);
  if (command.verb == Verb::export_model)
    return export_command(command, checked_case(command).the_case);
  if (command.verb == Verb::study)
    return study_command(command);
  if (command.verb == Verb::sweep)
    return sweep_command(command);
  if (command.verb == Verb::studio)
    return studio_command(command);
  if (command.verb == Verb::live)
    return live_command(command, read_case(command.target, command.sets));
  CommandLine without_record = command;  // which is too long to be looked at before
  without_record.force.clear();
  return stream_command(command, checked_case(without_record).the_case);
}
}  // namespace

const LinkedSubjects linked_subjects{chatter_kind, cluster_kind, solve_stand_chatter, solve_stack_chatter,
                                     subject_command};
}  // namespace mill
