#include "app/twin/calibrate/calibrate_command.h"
#include "app/process/address_space.h"
#include "app/process/console.h"
#include "app/run/output_dir.h"
#include "app/twin/calibrate/calibrated_case.h"
#include "app/twin/calibrate/detailed_prior.h"
#include "app/twin/calibrate/freed_unknowns.h"
#include "app/twin/calibrate/levels_text.h"
#include "app/twin/calibrate/record_plan.h"
#include "app/twin/stand/detail_parts.h"
#include "app/twin/stand/record_options.h"
#include "app/verbs/leading_model.h"
#include "core/base/files.h"
#include "core/base/visible_text.h"
#include "core/case/monitoring.h"
#include "core/model/case.h"
#include "core/records/csv.h"
#include "report/twin/calibration/calibration_page.h"
#include "report/twin/calibration/plan_page.h"
#include "twin/calibration/calibration_files.h"
#include "twin/calibration/verdict.h"
#include "twin/calibration/words.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

namespace fs = std::filesystem;

namespace mill {
namespace {
constexpr int refused_code = 3;

int threads_of(const CommandLine &command)
{
  const int wanted =
      command.threads > 0 ? command.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  return threads_that_start(threads_that_fit(wanted));
}

double model_error_of(const CalibrateOptions &options)
{
  if (options.model_error.empty())
    return twin::usual_model_error;
  const double error = option_quantity("--model-error", options.model_error, "5 %");
  if (!(error <= 0.5))
    throw InputError("--model-error \"" + options.model_error +
                     "\": must be above 0 % and at most 50 %, for example \"5 %\"");
  return error;
}

twin::CalibrationInput input_of(const CommandLine &command, const PriorChain &chain, const RecordSet &set,
                                MeasuredPieces pieces)
{
  twin::CalibrationInput input;
  input.stand          = chain.stand;
  input.unknowns       = freed_unknowns(chain, command.calibrate.free, pieces.force_recorded);
  input.force_recorded = pieces.force_recorded;
  input.model_error    = model_error_of(command.calibrate);
  if (command.calibrate.align && !input.force_recorded)
    throw InputError("--align: no force was recorded, so there is no second clock");
  if (command.calibrate.align)
    input.unknowns.push_back({twin::delay_name, 0.05, 0});
  input.sensors = pieces.sensors;
  for (const std::string &sensor : pieces.sensors)
    input.places.push_back(std::find(chain.places.begin(), chain.places.end(), sensor) - chain.places.begin());
  input.rate = pieces.rate;
  input.low  = set.band[0];
  input.high = std::min({set.band[1], pieces.rate / 2.56, chain.limit});
  if (!(input.high > 2 * input.low))
    throw InputError(fmt::format("{}: {:.6g} samples per second show nothing above {:.4g} Hz, the band begins at "
                                 "{:.4g} Hz; record faster, or give a band in records.toml",
                                 set.folder, pieces.rate, input.high, input.low));
  input.fit     = std::move(pieces.fit);
  input.check   = std::move(pieces.check);
  input.between = pieces.between;
  input.clipped = pieces.clipped;
  input.threads = threads_of(command);
  return input;
}

void write_calibration(const std::string &folder, const std::string &json,
                       const std::map<std::string, Table> &tables,
                       const std::map<std::string, std::string> &calibrated)
{
  replace_results(folder,
                  {"calibration.json", "response.csv", "profiles.csv", "force.csv", "report.html",
                   "calibrated.toml", "models"},
                  [&](const std::string &staged) {
                    for (const auto &[name, table] : tables)
                      write_atomically(staged + "/" + name + ".csv", csv_text(table));
                    for (const auto &[name, text] : calibrated) {
                      fs::create_directories(fs::path(staged + "/" + name).parent_path());
                      write_atomically(staged + "/" + name, text);
                    }
                    write_atomically(staged + "/report.html", report::calibration_page(folder, json, tables));
                    write_atomically(staged + "/calibration.json", json);
                  });
}

std::string line_of(const twin::Calibrated &u, const std::size_t width, const bool agrees, const bool written)
{
  if (!u.taken)
    return fmt::format("{:<{}} {:>10}  {}\n", u.name, width, "kept", u.why_not);
  const twin::ShownChange shown = twin::shown_change(u, written);
  return fmt::format("{:<{}} {:>10}  95 % {} .. {}{}\n", u.name, width, agrees ? "agrees" : shown.value, shown.low,
                     shown.high, u.identified ? "" : "; " + u.why_not);
}

void print_result(const twin::Calibration &result, const twin::CalibrationFacts &facts, const std::string &folder)
{
  using console::print;
  std::size_t width = 6;
  for (const twin::Calibrated &u : result.unknowns)
    width = std::max(width, u.name.size());
  for (const twin::Calibrated &u : result.unknowns)
    print(line_of(u, width, result.agrees, !facts.written.empty()));
  for (const std::string &direction : result.unseen)
    print("not seen: " + direction + "\n");
  for (const std::string &mode : twin::open_mode_words(result.modes))
    print(mode + "\n");
  print(fmt::format("check records: misfit {:.4g}, before {:.4g}; worst third octave at {:.2f} of its limit\n",
                    result.check.after, result.check.before, result.check.worst));
  for (const std::string &note : texts_of(facts.notes))
    print("note: " + visible(note, true) + "\n");
  for (const std::string &reason : result.refusals)
    print((facts.accepted ? "accepted although: " : "refused: ") + visible(reason, true) + "\n");
  if (result.refusals.empty() && result.agrees)
    print(twin::agreement_words(result) + "\n");
  if (!facts.written.empty())
    print("calibrated case: " + folder + "/" + facts.written + "\n");
  print("report: " + folder + "/report.html\n");
}

void add_notes_without_force(std::vector<Note> &notes, const Case &the_case, const bool load_given)
{
  if (std::holds_alternative<FourHigh>(the_case.spec) && !load_given)
    notes.emplace(notes.begin(), NoteId::load_of_first_pass, "",
                  "the contacts are those at the load of the first pass", "",
                  "if the records had another load, give it in records.toml, for example load = \"976 kN\"");
  notes.emplace(notes.begin(), NoteId::force_not_recorded, "", twin::without_force_words());
}

PriorChain prior_of_case(const CommandLine &command, const Case &the_case, const double load)
{
  if (is_detailed(the_case))
    return detailed_prior(command, the_case, load);
  PriorChain prior = prior_chain(the_case, load);
  if (const auto warning = warning_of_six_masses(the_case, "calibrate"))
    prior.notes.push_back(*warning);
  return prior;
}

/// A four-high stand at the load of the records, which its contacts follow.  A stand of finite elements is not
/// computed again for a load near that of its pass; a stand in files stays as it is.
PriorChain at_load_of(const CommandLine &command, const Case &the_case, const PriorChain &at_first_pass,
                      const double load)
{
  constexpr double nearly = 0.02;  // of the load: 0.1 % of a line contact
  const bool same         = at_first_pass.detailed && !(std::abs(load / at_first_pass.load - 1) > nearly);
  return load > 0 && !same ? prior_of_case(command, the_case, load) : at_first_pass;
}

int calibrate_records(const CommandLine &command, const Case &the_case, const RecordSet &set)
{
  const std::string folder = command.output.empty() ? "out/" + the_case.name + "-calibration" : command.output;
  require_result_folder(folder, "calibration.json", "calibration", command.force_overwrite);
  console::next_bar_ends_at(0.3);  // where finite elements make the prior
  const PriorChain at_first_pass = prior_of_case(command, the_case, std::nan(""));
  console::next_bar_ends_at(1);
  // wrong options are refused before long records are read
  freed_unknowns(at_first_pass, command.calibrate.free, true);
  model_error_of(command.calibrate);
  console::ProgressBar bar({{"read", 3}, {"start", 1}, {"fit", 1}, {"basins", 6}, {"check", 1}}, command.quiet);
  Progress progress;
  progress.step = [&](const std::string &stage, const double fraction) { bar.show(stage, fraction); };
  progress.at("read", 0);
  MeasuredPieces pieces = measured_pieces(set, at_first_pass.places, read_options(command, Monitoring()),
                                          monitoring_of(command.target, command.sets).channels());
  console::next_bar_ends_at(0.5);
  const PriorChain chain = at_load_of(command, the_case, at_first_pass, pieces.load);
  twin::CalibrationFacts facts{the_case.name, chain.source, pieces.files,
                               pieces.notes,  "",           command.calibrate.accept};
  facts.notes.insert(facts.notes.end(), chain.notes.begin(), chain.notes.end());
  if (!pieces.force_recorded)
    add_notes_without_force(facts.notes, the_case, pieces.load > 0);
  const twin::CalibrationInput input = input_of(command, chain, set, std::move(pieces));
  for (const twin::Unknown &unknown : input.unknowns)
    if (twin::moves(unknown) == twin::Moves::ratio)
      facts.notes.push_back(Warning{
          WarningId::one_damping_ratio, unknown.name,
          "a case has one damping ratio for all modes; calibrated.toml takes the geometric mean of the ratios "
          "of the modes, and each is in the report and in its head"});
  const twin::Calibration result = twin::calibrate(input, progress);
  const bool refused             = !result.refusals.empty();
  if (result.delay && result.delay->significant() && !result.delay->too_large())
    facts.notes.emplace_back(NoteId::clock_delay, "", result.delay->words(input.rate));
  std::map<std::string, std::string> calibrated;
  if (refused ? command.calibrate.accept : !result.agrees) {
    facts.written = "calibrated.toml";
    if (chain.detailed)
      calibrated = calibrated_model(chain, the_case, result, facts.files, refused, folder);
    else
      calibrated[facts.written] = calibrated_toml(chain, the_case, result, facts.files, refused, folder);
  }
  write_calibration(folder, twin::calibration_json(input, result, facts), twin::calibration_tables(result),
                    calibrated);
  bar.finish();
  if (!command.quiet)
    print_result(result, facts, folder);
  else if (refused && !command.calibrate.accept)
    console::say("refused: " + visible(result.refusals.front(), true) + "; report: " + folder + "/report.html\n");
  return refused && !command.calibrate.accept ? refused_code : 0;
}

/// --plan: to the console, and with -o into a folder.
int plan_record(const CommandLine &command, const Case &the_case)
{
  const std::string &folder = command.output;
  if (!folder.empty())
    require_result_folder(folder, "plan.json", "plan", command.force_overwrite);
  const PriorChain prior = prior_of_case(command, the_case, std::nan(""));
  const bool recorded    = !command.calibrate.without_force;
  const RecordPlan plan  = record_plan(prior, the_case.name,
                                       freed_unknowns(prior, command.calibrate.free, recorded), command.calibrate);
  if (!command.quiet || folder.empty())
    console::print(plan_text(plan));
  if (folder.empty())
    return 0;
  const std::string json = plan_json(plan);
  replace_results(folder, {"plan.json", "report.html"}, [&](const std::string &staged) {
    write_atomically(staged + "/report.html", report::plan_page(folder, json));
    write_atomically(staged + "/plan.json", json);
  });
  if (!command.quiet)
    console::print("report: " + folder + "/report.html\n");
  return 0;
}
}  // namespace

int calibrate_command(const CommandLine &command)
{
  const Case the_case = with_leading_model(read_case(command.target, command.sets), command);
  if (command.calibrate.plan)
    return plan_record(command, the_case);
  if (command.calibrate.measured.empty())
    throw InputError(
        "millstand calibrate: no records; name their folder with --measured DIR, or use --plan to see "
        "which unknowns a record would identify");
  const RecordSet set = read_record_set(command.calibrate.measured);
  if (set.entries.empty()) {
    console::print(levels_text(prior_of_case(command, the_case, std::nan("")), set));
    return refused_code;
  }
  return calibrate_records(command, the_case, set);
}
}  // namespace mill
