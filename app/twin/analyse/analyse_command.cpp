#include "app/twin/analyse/analyse_command.h"
#include "app/process/address_space.h"
#include "app/process/console.h"
#include "app/run/output_dir.h"
#include "app/twin/analyse/analysed_stand.h"
#include "app/twin/analyse/analysis_lines.h"
#include "app/twin/stand/record_options.h"
#include "app/verbs/leading_model.h"
#include "core/base/files.h"
#include "core/base/visible_text.h"
#include "core/case/monitoring.h"
#include "core/case/plant.h"
#include "core/model/case.h"
#include "core/records/csv.h"
#include "core/records/source_location.h"
#include "report/twin/analysis/analysis_page.h"
#include "twin/analysis/analysis_files.h"
#include "twin/records/raw_record.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <thread>

namespace fs = std::filesystem;

namespace mill {
namespace {
twin::AnalysisSettings settings_of(const CommandLine &command, const Monitoring &monitoring, const Plant &plant)
{
  twin::AnalysisSettings settings;
  if (std::isfinite(plant.mains))
    settings.mains = plant.mains;
  if (!command.speed.empty())
    settings.speed = option_quantity("--speed", command.speed, "4 m/s");
  settings.limit = own_limit(command, monitoring);
  for (const std::string &zone : command.severity)
    settings.severity.push_back(option_quantity("--severity", zone, "2.3 mm/s"));
  if (!std::is_sorted(settings.severity.begin(), settings.severity.end()))
    throw InputError(
        "--severity: the upper ends of the zones grow, for example \"2.3 mm/s\" \"4.5 mm/s\" \"7.1 mm/s\"");
  if (settings.severity.empty())
    settings.severity = monitoring.zones();
  settings.bands                     = {{"third_octave", monitoring.third_octave[0], monitoring.third_octave[1]},
                                        {"fifth_octave", monitoring.fifth_octave[0], monitoring.fifth_octave[1]}};
  std::vector<std::string> baselines = command.baseline;
  if (baselines.empty() && !monitoring.baseline.empty())
    baselines.push_back(monitoring.baseline);
  if (!baselines.empty())
    settings.baseline = twin::read_baselines(baselines);
  settings.align = command.align;
  const int wanted =
      command.threads > 0 ? command.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  settings.threads = threads_that_start(threads_that_fit(wanted));
  return settings;
}

void write_folder(const std::string &folder, const twin::CleanRecord &record, const twin::Analysis &analysis,
                  const twin::CaseModel *stand, const twin::AnalysisSettings &settings)
{
  const auto tables      = twin::analysis_tables(analysis);
  const std::string json = twin::analysis_json(record, analysis, stand, settings);
  replace_results(folder,
                  {"analysis.json", "spectrum.csv", "waterfall.csv", "distance.csv", "modes.csv", "poles.csv",
                   "singular.csv", "h1.csv", "modes_h1.csv", "candidates.csv", "report.html"},
                  [&](const std::string &staged) {
                    for (const auto &[name, table] : tables)
                      write_atomically(staged + "/" + name + ".csv", csv_text(table));
                    write_atomically(staged + "/candidates.csv", twin::candidates_csv(analysis));
                    write_atomically(staged + "/report.html", report::analysis_page(folder, json, tables));
                    write_atomically(staged + "/analysis.json", json);
                  });
}

// "rec-analysis" for "day1/rec.csv", where nothing else is said.
std::string folder_of(const CommandLine &command, const std::string &path)
{
  const std::string stem = fs::path(path).stem().string();
  return command.output.empty()      ? "out/" + stem + "-analysis"
         : command.names.size() == 1 ? command.output
                                     : command.output + "/" + stem;
}

void require_different_folders(const CommandLine &command)
{
  std::map<std::string, std::string> folders;  // and the record of each
  for (const std::string &path : command.names)
    if (const auto [other, is_new] = folders.emplace(folder_of(command, path), path); !is_new)
      throw InputError("the records " + other->second + " and " + path + " would both write to the folder " +
                       other->first + "; analyse them one after the other, each with its own -o");
}

// A baseline of later days is not replaced by the record of another day that has the same name.
void require_same_record(const std::string &folder, const std::string &path, const CommandLine &command)
{
  const std::string other = command.force_overwrite ? "" : other_source(folder + "/analysis.json", path);
  if (!other.empty())
    throw InputError("the folder " + folder + " holds the analysis of another record, " + other +
                     "; choose another with -o, or give --force-overwrite");
}
}  // namespace

int analyse_command(const CommandLine &command)
{
  std::optional<twin::CaseModel> stand;
  Monitoring monitoring;
  Plant plant;
  if (!command.case_file.empty()) {
    const Case the_case = read_case(command.case_file, command.sets);
    stand               = analysed_stand(the_case, leading_model(the_case, command) == StandModelKind::six_mass);
    monitoring          = monitoring_of(command.case_file, command.sets);
    plant               = plant_of(command.case_file, command.sets);
    add_ball_bearings(*stand, monitoring.ball_bearings);
  }
  const twin::ReadOptions reading       = read_options(command, monitoring);
  const twin::AnalysisSettings settings = settings_of(command, monitoring, plant);
  require_different_folders(command);
  for (const std::string &path : command.names) {
    const std::string folder = folder_of(command, path);
    twin::RawRecord raw;
    console::next_bar_ends_at(double(&path - command.names.data() + 1) / double(command.names.size()));
    console::ProgressBar bar({{"read", 3}, {"clean", 1}, {"spectra", 4}, {"modes", 3}, {"findings", 1}},
                             command.quiet);
    Progress progress;
    progress.step = [&](const std::string &stage, const double fraction) { bar.show(stage, fraction); };
    progress.at("read", 0);
    raw = twin::read_record(path, reading);
    require_result_folder(folder, "analysis.json", "analysis", command.force_overwrite);
    require_same_record(folder, path, command);
    progress.at("clean", 0);
    const twin::CleanRecord record = twin::clean_record(std::move(raw));
    raw                            = {};  // its times are done with
    const twin::Analysis analysis  = twin::analyse(record, stand ? &*stand : nullptr, settings, progress);
    write_folder(folder, record, analysis, stand ? &*stand : nullptr, settings);
    bar.finish();
    if (!command.quiet)
      for (const std::string &line : analysis_lines(analysis, folder))
        console::print(line + "\n");
  }
  return 0;
}
}  // namespace mill
