#include "app/twin/advice/advise_command.h"
#include "app/process/address_space.h"
#include "app/process/console.h"
#include "app/run/output_dir.h"
#include "app/stages/stand/stand_components.h"
#include "app/twin/advice/cluster_advice.h"
#include "app/twin/advice/critical_speed_advice.h"
#include "app/twin/advice/pass_speed_advice.h"
#include "app/twin/advice/stand_advice.h"
#include "app/twin/stand/record_options.h"
#include "app/verbs/driven_case.h"
#include "core/base/files.h"
#include "core/base/visible_text.h"
#include "core/case/advice_rows.h"
#include "core/case/monitoring.h"
#include "core/model/case.h"
#include "report/twin/advice/advice_page.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

namespace fs = std::filesystem;

namespace mill {
namespace {
constexpr std::size_t most_said = 12;  // actions on the console

void write_advice(const std::string &folder, const twin::AdviceRecord &record)
{
  const std::string json = advice_json(record);
  replace_results(folder,
                  {"advice.json", "advice.csv", "spectrum.csv", "detuning.csv", "growth.csv", "report.html"},
                  [&](const std::string &staged) {
                    write_atomically(staged + "/advice.csv", advice_csv(record));
                    for (const auto &[name, table] : record.tables)
                      write_atomically(staged + "/" + name + ".csv", csv_text(table));
                    write_atomically(staged + "/report.html", report::advice_page(folder, json, record.tables));
                    write_atomically(staged + "/advice.json", json);
                  });
}

void say_action(const twin::RatedAction &action, const std::size_t rank)
{
  const auto percent = [](const double part) {
    return std::isfinite(part) ? fmt::format("{:+.2f} %", 100 * part) : std::string("-");
  };
  std::string reason;
  for (const std::string &sentence : action.against)
    reason += (reason.empty() ? "  " : "; ") + sentence;
  console::print(visible(fmt::format("{:>3} {:>9} {:>9} {:>9}  {}{}", rank > 0 ? std::to_string(rank) : "-",
                                     percent(action.verified), percent(action.change), percent(action.first_order),
                                     action.name, reason),
                         true) +
                 "\n");
}

void say_advice(const twin::AdviceRecord &record, const std::string &folder)
{
  using console::print;
  print(visible("goal: " + record.question, true) + "\n" + visible(record.answer, true) + "\n\n");
  print("   decisive recomputed  linear\n");
  const std::size_t above = above_the_line(record.actions), n = record.actions.size();
  for (std::size_t i = 0; i < std::min(above, most_said); ++i)
    say_action(record.actions[i], i + 1);
  if (above < n)
    print("  ------------------ rejected: no help, or a limit is violated\n");
  for (std::size_t i = above; i < std::min(n, above + most_said); ++i)
    say_action(record.actions[i], 0);
  if (const std::size_t more = std::max(above, most_said) - most_said + std::max(n - above, most_said) - most_said;
      more > 0)
    print(fmt::format("  {} more in advice.csv\n", more));
  if (!record.what_ifs.empty())
    print("  ------------------ what if the damping were another one\n");
  for (const twin::RatedAction &what_if : record.what_ifs)
    say_action(what_if, 0);
  for (const std::string &note : texts_of(record.notes))
    print("note: " + visible(note, true) + "\n");
  print("report: " + folder + "/report.html\n");
}

int threads_for(const CommandLine &command)
{
  const int wanted =
      command.threads > 0 ? command.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  return threads_that_start(threads_that_fit(wanted));
}
}  // namespace

int advise_command(const CommandLine &command, const Case &the_case)
{
  const bool stack = std::holds_alternative<ClusterCase>(the_case.spec);
  const bool speed = stack || std::holds_alternative<ChatterCase>(the_case.spec);
  if (!speed && !std::holds_alternative<FourHigh>(the_case.spec) && !std::holds_alternative<Lumped>(the_case.spec))
    throw InputError("millstand advise has nothing to advise for kind = \"" + the_case.kind + "\" (" +
                     the_case.path +
                     "); it takes four-high and lumped for the level of a place, four-high, cluster and chatter "
                     "for the critical speed");
  if (speed && !command.measured.empty())
    throw InputError(
        "--measured " + command.measured +
        ": a critical speed does not follow from a measured force; leave it out, or name a case of kind "
        "four-high or lumped for the level of a place");
  const twin::ReadOptions reading = read_options(command, monitoring_of(the_case.path, command.sets));
  const std::string folder        = command.output.empty() ? "out/" + the_case.name + "-advice" : command.output;
  const auto rolled               = std::holds_alternative<FourHigh>(the_case.spec)
                                        ? rolled_advice_of(the_case.path, command.sets)
                                        : RolledAdvice();
  const auto components           = [&] {
    reduce::StandComponents rolls;
    run_in_scratch(command, the_case, {{"components", 1}}, [&](RunContext &run) {
      rolls = stand_components(run, std::get<FourHigh>(the_case.spec), false).fine;
      say_warnings(run.results.warnings);
    });
    return rolls;
  };
  const twin::AdviceRecord record = stack   ? cluster_advice(the_case, threads_for(command))
                                    : speed ? critical_speed_advice(the_case, threads_for(command))
                                    : asks_critical_speed(the_case, rolled, command.measured)
                                        ? pass_speed_advice(the_case, rolled, components, threads_for(command))
                                        : stand_advice(the_case, command.measured, reading, rolled, components);
  require_result_folder(folder, "advice.json", "advice", command.force_overwrite);
  write_advice(folder, record);
  if (!command.quiet)
    say_advice(record, folder);
  return 0;
}
}  // namespace mill
