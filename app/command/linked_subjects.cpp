#include "app/command/linked_subjects.h"
#include "app/process/hand_over.h"
#include "core/model/case.h"
#include "core/records/result_folder.h"
#include <filesystem>

namespace fs = std::filesystem;

namespace mill {
namespace {
[[noreturn]] void hand_over_to_all(const CommandLine &command, const std::string &what)
{
  hand_over("millstand-all", command.arguments, what);
}
}  // namespace

bool is_folder_of_records(const std::string &directory)
{
  const WholeRun complete(directory);  // what a killed program was replacing is in its place now
  return !fs::exists(directory + "/results.json") &&
         (fs::exists(directory + "/calibration.json") || fs::exists(directory + "/plan.json") ||
          fs::exists(directory + "/analysis.json") || fs::exists(directory + "/advice.json") ||
          fs::exists(directory + "/sweep.json"));
}

bool is_streamed(const CommandLine &command)
{
  std::error_code error;
  return command.verb == Verb::simulate &&
         (command.stream || (!command.force.empty() && fs::is_regular_file(command.force, error) &&
                             (long long)(fs::file_size(command.force, error)) > longest_in_memory));
}

bool is_of_subjects(const CommandLine &command)
{
  const Verb verb = command.verb;
  return verb == Verb::analyse || verb == Verb::calibrate || verb == Verb::advise || verb == Verb::live ||
         verb == Verb::export_model || verb == Verb::sweep || verb == Verb::study || verb == Verb::studio ||
         is_streamed(command) || (verb == Verb::report && is_folder_of_records(command.target));
}

int carry_out_subject(const CommandLine &command)
{
  if (linked_subjects.command)
    return linked_subjects.command(command);
  // Of the verb report only the pages of its folders are there.
  hand_over_to_all(command, command.verb == Verb::report ? "the page of records"
                            : is_streamed(command)       ? "millstand simulate --stream"
                                                         : std::string("millstand ") + word_of(command.verb));
}

void require_linked(const Case &the_case, const CommandLine &command)
{
  if (std::holds_alternative<ChatterCase>(the_case.spec) && !linked_subjects.chatter)
    hand_over_to_all(command, "kind = \"chatter\"");
  if (std::holds_alternative<ClusterCase>(the_case.spec) && !linked_subjects.cluster)
    hand_over_to_all(command, "kind = \"cluster\"");
  if (command.verb == Verb::chatter && !linked_subjects.stand_chatter)
    hand_over_to_all(command, "millstand chatter");
}
}  // namespace mill
