#include "app/study/study_new.h"
#include "app/process/console.h"
#include "app/process/version.h"
#include "app/run/run_setup.h"
#include "app/run/scratch_folder.h"
#include "app/study/analysis_program.h"
#include "app/study/linear_estimate.h"
#include "app/study/row_list.h"
#include "app/study/study_folder.h"
#include "app/verbs/checked_case.h"
#include "core/base/files.h"
#include "core/base/short_number.h"
#include "core/model/case.h"
#include "core/process/parallel.h"
#include "report/results/names.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <numeric>

namespace mill {
namespace {
constexpr long many_rows              = 10000000;
constexpr std::size_t most_refusals   = 10;
constexpr long starts_of_input        = 12;  // of optimise, where --samples is not given
const char *const geometry_sections[] = {"work_roll.", "backup_roll.", "steel.", "intermediate_roll."};

// Nothing is given where Python leaves it out.
StudyMethod method_of(const CommandLine &command)
{
  return choice_named<StudyMethod>(command.study.method).value_or(StudyMethod::latin_hypercube);
}

bool is_random(const StudyMethod method)
{
  return method != StudyMethod::grid && method != StudyMethod::list;
}

std::vector<UncertainKey> keys_of_command(const CommandLine &command, const Case &base)
{
  std::vector<UncertainKey> keys;
  std::vector<std::string> names;
  const StudyMethod method = method_of(command);
  for (const std::string &written : command.sweep.vary) {
    if (is_random(method) && !is_distribution(written))
      throw InputError("--vary " + written + ": --method " + word_of(method) +
                       (method == StudyMethod::optimise
                            ? " searches between bounds, KEY~uniform(low, high) UNIT"
                            : " draws from distributions, KEY~uniform(low, high) UNIT") +
                       "; values KEY=a,b belong to --method grid");
    if (!is_random(method) && is_distribution(written))
      throw InputError(
          "--vary " + written + ": --method " + word_of(method) +
          " takes values, KEY=a,b,c; distributions belong to latin-hypercube, monte-carlo, sobol and chaos");
    if (is_distribution(written))
      keys.push_back(uncertain_key(base, command.sets, written));
    else
      keys.push_back({varied_key(base, command.sets, written), {}, split_variation(written, '=').values});
    if (method == StudyMethod::optimise && keys.back().spread.kind != Spread::Kind::uniform)
      throw InputError("--vary \"" + written +
                       "\": --method optimise takes the bounds of each key: KEY~uniform(low, high) UNIT");
    names.push_back(keys.back().key.name);
  }
  require_different_keys(names);
  return keys;
}

// The result whose least or greatest value is searched.
void set_objective(const StudyOptions &options, Study &study)
{
  study.greatest  = !options.maximise.empty();
  study.objective = study.greatest ? options.maximise : options.minimise;
  if (study.method == StudyMethod::optimise && study.objective.empty())
    throw InputError(
        "--method optimise has no objective: give --minimise RESULT or --maximise RESULT, a name of results.json");
  if (study.method != StudyMethod::optimise && !study.objective.empty())
    throw InputError("--minimise and --maximise belong to --method optimise");
}

bool is_power_of_two(const long n)
{
  return n > 0 && (n & (n - 1)) == 0;
}

void require_samples(const StudyMethod method, const long n)
{
  if (n < 2)
    throw InputError(std::string("--method ") + word_of(method) + " needs --samples N with N of 2 or more");
  if (method == StudyMethod::sobol && !is_power_of_two(n)) {
    long below = 1;
    while (2 * below < n)
      below *= 2;
    throw InputError(
        fmt::format("--samples {}: sobol takes a power of two; the next ones are {} and {}", n, below, 2 * below));
  }
}

// A key that is written as words has the place of the word as its number.
std::vector<double> axis_of(const UncertainKey &key)
{
  std::vector<double> axis = key.key.numbers;
  if (std::any_of(axis.begin(), axis.end(), [](const double number) { return std::isnan(number); }))
    std::iota(axis.begin(), axis.end(), 0.0);
  return axis;
}

std::vector<std::vector<double>> grid_rows(const std::vector<UncertainKey> &keys)
{
  std::vector<std::vector<double>> rows(1);
  for (const UncertainKey &key : keys) {
    std::vector<std::vector<double>> longer;
    for (const auto &row : rows)
      for (const double number : axis_of(key)) {
        longer.push_back(row);
        longer.back().push_back(number);
      }
    rows = std::move(longer);
  }
  return rows;
}

// The rows of a method that draws.
std::vector<std::vector<double>> drawn_rows_of(Study study)
{
  if (study.method != StudyMethod::chaos)
    return draw_rows(study, study.method == StudyMethod::optimise ? StudyMethod::latin_hypercube : study.method,
                     study.samples);
  auto rows = draw_rows(study, StudyMethod::latin_hypercube, study.samples);
  ++study.seed;
  const auto held_out = draw_rows(study, StudyMethod::monte_carlo, held_out_rows(study));
  rows.insert(rows.end(), held_out.begin(), held_out.end());
  return rows;
}

long expected_rows(const Study &study)
{
  if (study.method == StudyMethod::sobol)
    return study.samples * long(study.keys.size() + 2);
  if (study.method != StudyMethod::grid)
    return study.samples + held_out_rows(study);
  double rows = 1;
  for (const UncertainKey &key : study.keys)
    rows *= double(key.key.values.size());
  return long(std::min(rows, 1e18));
}

// Every row as a case, with its place in a list; all refused rows are named before the study exists.
std::vector<std::int64_t> checked_keys(const Study &study, const std::vector<std::vector<double>> &rows,
                                       const std::vector<Place> &places, const int threads, const bool quiet)
{
  std::vector<std::int64_t> keys(rows.size());
  std::map<std::size_t, std::vector<Problem>> refused;
  std::mutex access;
  console::ProgressBar bar({{"check of the rows", 1}}, quiet);
  std::size_t done = 0;
  share_tasks(long(rows.size()), threads, [&](const long i) {
    std::vector<Problem> problems;
    try {
      keys[std::size_t(i)] = row_key(checked_row(study.case_path, sets_of(study, rows[std::size_t(i)])));
    } catch (const InputError &e) {
      problems = e.problems;
    }
    const std::lock_guard lock(access);
    if (!problems.empty())
      refused[std::size_t(i)] = problems;
    if (++done % 1024 == 0)
      bar.show("check of the rows", double(done) / double(rows.size()));
  });
  bar.finish();
  std::vector<Problem> problems;
  for (const auto &[place, its_problems] : refused)
    for (Problem problem : its_problems)
      if (problems.size() < most_refusals) {
        problem.message = row_name(study, {0, std::int64_t(place) + 1, 0, rows[place]}) + ": " + problem.message;
        if (problem.place.line == 0 && !places.empty())
          problem.place = places[place];
        problems.push_back(problem);
      }
  if (refused.size() > most_refusals)
    problems.push_back({{}, fmt::format("{} of {} rows are refused", refused.size(), rows.size()), {}});
  if (!problems.empty())
    throw InputError(problems);
  return keys;
}

// Rows with the same rolls are neighbours, so that a shard condenses them once.
std::vector<DesignRow> ordered_rows(const Study &study, std::vector<std::vector<double>> rows,
                                    const std::vector<std::int64_t> &keys)
{
  std::vector<std::size_t> geometry;
  for (std::size_t k = 0; k < study.keys.size(); ++k)
    for (const char *section : geometry_sections)
      if (study.keys[k].key.name.rfind(section, 0) == 0)
        geometry.push_back(k);
  std::vector<DesignRow> ordered;
  for (std::size_t i = 0; i < rows.size(); ++i)
    ordered.push_back({0, std::int64_t(i) + 1, keys[i], std::move(rows[i])});
  std::stable_sort(ordered.begin(), ordered.end(), [&](const DesignRow &a, const DesignRow &b) {
    for (const std::size_t k : geometry)
      if (a.numbers[k] != b.numbers[k])
        return a.numbers[k] < b.numbers[k];
    return false;
  });
  for (std::size_t place = 0; place < ordered.size(); ++place)
    ordered[place].place = std::int64_t(place);
  return ordered;
}

// The folder of a new study; one that holds another design is refused.
void require_study_folder(const Study &study, const bool overwrite)
{
  std::error_code ignored;
  if (!overwrite && std::filesystem::exists(study.folder + "/study.toml", ignored)) {
    const Study there        = read_study(study.folder);
    const std::string differ = differences(there, study), discard = "--force-overwrite, which discards its rows";
    if (differ.empty())
      throw InputError("the folder " + study.folder +
                       " holds this study already; go on with: millstand study run " + study.folder +
                       ", or give " + discard);
    throw InputError("the folder " + study.folder + " holds a study of " + there.case_name + " by " +
                     word_of(there.method) + fmt::format(" with {} rows", there.rows) +
                     "; choose another with -o, or give " + discard + differ);
  }
  require_result_folder(study.folder, "study.toml", "study", overwrite);
  for (const char *old :
       {"rows", "samples", "finished.db", "study.db", "study.toml", "results.csv", "report.html", "report.json"})
    std::filesystem::remove_all(study.folder + "/" + old, ignored);
}

NamedResults chosen(const CommandLine &command, const Study &study, RowModel &model, const Case &base)
{
  auto watched = command.sweep.watch;
  if (study.objective.empty())
    return model.choose(base, watched);
  if (std::find(watched.begin(), watched.end(), study.objective) == watched.end())
    watched.push_back(study.objective);
  try {
    return model.choose(base, watched);
  } catch (const InputError &e) {
    const std::string as_watched = "--watch " + study.objective + ":", message = e.problems.front().message;
    if (message.rfind(as_watched, 0) != 0)
      throw;
    throw InputError((study.greatest ? "--maximise " : "--minimise ") +
                     message.substr(std::string("--watch ").size()));
  }
}

// The watched results of the base case, and the seconds that it took.
void watch(const CommandLine &command, const Case &base, const RunContext &setup, Study &study)
{
  RowModel model({study.model, setup.cache, command.fresh, setup.threads});
  for (const auto &[name, result] : chosen(command, study, model, base))
    study.watched.push_back({name, result.unit, report::meaning_of(name), result.value, result.error_estimate});
  study.work       = model.work();
  const auto start = std::chrono::steady_clock::now();
  model.results(base);
  study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (is_random(study.method) && study.method != StudyMethod::optimise)
    add_slopes(study, model);
}
}  // namespace

int study_new(const CommandLine &command)
{
  const Case base = checked_case(command).the_case;
  Study study;
  study.folder       = command.output.empty() ? "out/" + base.name + "-study" : command.output;
  study.case_path    = std::filesystem::absolute(base.path).lexically_normal().string();
  study.case_name    = base.name;
  study.title        = base.title;
  study.sets         = command.sets;
  study.method       = method_of(command);
  study.samples      = command.study.samples;
  study.seed         = command.study.seed;
  study.model        = choice_named<ModelKind>(command.sweep.model).value_or(ModelKind::full);
  study.correlations = command.study.correlate;
  study.version      = version();
  set_objective(command.study, study);
  cache_limit(command);  // before anything is computed
  study.base = hash_of(read_case(study.case_path, study.sets).resolved);
  std::vector<std::vector<double>> rows;
  std::vector<Place> places;
  if (study.method == StudyMethod::list) {
    RowList list = read_row_list(base, command.sets, command.study.list);
    study.keys   = std::move(list.keys);
    rows         = std::move(list.rows);
    places       = std::move(list.places);
  } else {
    study.keys = keys_of_command(command, base);
    if (study.keys.empty())
      throw InputError("millstand study new needs --vary KEY~distribution, --vary KEY=values or --list FILE");
    if (study.method == StudyMethod::optimise && study.samples == 0)
      study.samples = starts_of_input * long(study.keys.size());
    if (is_random(study.method))
      require_samples(study.method, study.samples);
    if ((study.method == StudyMethod::chaos || study.method == StudyMethod::optimise) &&
        !study.correlations.empty())
      throw InputError(word_of(study.method) +
                       std::string(" takes independent inputs; leave --correlate out, or use another method"));
  }
  if (const long n = expected_rows(study); n > many_rows && !command.study.yes)
    throw InputError(fmt::format("the study has {} rows, more than ten million; give --yes if that is meant", n));
  if (study.method == StudyMethod::grid)
    rows = grid_rows(study.keys);
  else if (is_random(study.method))
    rows = drawn_rows_of(study);
  study.rows = long(rows.size());

  const ScratchFolder scratch("millstand-study");
  const OutputDir out(scratch.path(), base, true, "study");
  RunContext setup{base, out, cache_folder(command, study.folder + "/" + usual_cache)};
  open_cache(setup, out.staging());
  set_up_threads(setup, command);
  const auto keys = checked_keys(study, rows, places, setup.threads, command.quiet);
  watch(command, base, setup, study);
  require_study_folder(study, command.force_overwrite);
  write_study(study, ordered_rows(study, std::move(rows), keys));
  if (!command.quiet)
    console::print(fmt::format(
        "{}: {} rows by {}, {} s each for one process; start them with: millstand study run {}\n", study.folder,
        study.rows, word_of(study.method), short_number(study.seconds, 2), study.folder));
  return 0;
}
}  // namespace mill
