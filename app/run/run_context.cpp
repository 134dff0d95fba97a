#include "app/run/run_context.h"
#include "app/process/out_of_memory.h"
#include "app/process/version.h"
#include "app/run/run_kind.h"
#include "core/base/files.h"
#include "core/base/name_part.h"
#include "core/base/valid_text.h"
#include "core/case/kinds.h"
#include "core/case/moving_keys.h"
#include "core/numerics/sparse.h"
#include "core/process/parallel.h"
#include "core/records/run_identity.h"
#include "core/records/source_location.h"
#include "fem/body/elastic_body.h"
#include "meshes/common/mesher.h"
#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace mill {
using json = nlohmann::ordered_json;

std::shared_ptr<MovingKeys> moving_keys_of(const Case &the_case)
{
  return std::make_shared<MovingKeys>(the_case.spec);
}

void RunContext::warn(Warning warning)
{
  for (std::string Warning::*part : {&Warning::subject, &Warning::fact, &Warning::detail, &Warning::remedy})
    warning.*part = with_plain_names(warning.*part);
  if (const auto place = the_case.places.find(warning.key);
      warning.place.file.empty() && place != the_case.places.end())
    warning.place = place->second;
  auto &warnings = results.warnings;
  if (std::find(warnings.begin(), warnings.end(), warning) != warnings.end())
    return;
  progress.note("warning: " + text_of(warning));
  warnings.push_back(std::move(warning));
}

void RunContext::assume(const std::string &text)
{
  const std::string sentence = with_plain_names(text);
  results.assumptions.push_back(sentence);
  progress.note("assumed: " + sentence);
}

RunContext RunContext::branch() const
{
  RunContext part_run{the_case, out, cache, fresh, made, keys, threads, progress};
  part_run.started = started;
  part_run.asked   = asked;
  part_run.earlier = this;
  return part_run;
}

const Parameter *RunContext::find(const std::string &name) const
{
  const Parameter *result = results.find(name);
  return result || !earlier ? result : earlier->find(name);
}

void RunContext::absorb(RunContext &&other)
{
  results.append(std::move(other.results.values));
  for (const Warning &warning : other.results.warnings)
    if (std::find(results.warnings.begin(), results.warnings.end(), warning) == results.warnings.end())
      results.warnings.push_back(warning);
  const auto append = [](auto &all, auto &more) { all.insert(all.end(), more.begin(), more.end()); };
  append(results.assumptions, other.results.assumptions);
  append(results.speeds, other.results.speeds);
  append(times, other.times);
  summary += other.summary;
}

SideBySide::SideBySide(RunContext &parent) : run(parent) {}

void SideBySide::add(IndependentStage stage)
{
  stages.push_back(std::move(stage));
}

void SideBySide::work()
{
  for (std::size_t i = 0; i < stages.size(); ++i)
    branches.push_back(run.branch());
  failures.resize(stages.size());
  std::atomic<long> first_failure{long(stages.size())};
  share_tasks(long(stages.size()), run.threads, [&](const long i) {
    if (i > first_failure)
      return;
    try {
      stages[std::size_t(i)](branches[std::size_t(i)]);
    } catch (...) {
      failures[std::size_t(i)] = std::current_exception();
      long first               = first_failure;
      while (i < first && !first_failure.compare_exchange_weak(first, i)) {
      }
    }
  });
}

bool SideBySide::failed(const std::size_t i) const
{
  return failures.at(i) != nullptr;
}

void SideBySide::take(const std::size_t i)
{
  run.absorb(std::move(branches.at(i)));
  if (failures.at(i))
    std::rethrow_exception(failures[i]);
}

void run_side_by_side(RunContext &run, std::vector<IndependentStage> stages)
{
  SideBySide all(run);
  const std::size_t n = stages.size();
  for (IndependentStage &stage : stages)
    all.add(std::move(stage));
  all.work();
  for (std::size_t i = 0; i < n; ++i)
    all.take(i);
}

bool MadeKeys::count(const std::string &key) const
{
  const std::lock_guard lock(access);
  return made.count(key) > 0;
}

void MadeKeys::insert(const std::string &key)
{
  const std::lock_guard lock(access);
  made.insert(key);
}

MadeKeys::Turn::Turn(MadeKeys &all_keys, std::string of_part) : keys(all_keys), key(std::move(of_part))
{
  std::unique_lock lock(keys.access);
  keys.released.wait(lock, [&] { return keys.taken.count(key) == 0; });
  keys.taken.insert(key);
}

MadeKeys::Turn::~Turn()
{
  {
    const std::lock_guard lock(keys.access);
    keys.taken.erase(key);
  }
  keys.released.notify_all();
}

namespace {
// The stages that run, the last one begun last; one that an exception leaves stays, so that it can be named.
struct StagesInProgress {
  std::mutex access;
  std::vector<std::string> names;
};

StagesInProgress &in_progress()
{
  static StagesInProgress stages;
  return stages;
}
}  // namespace

std::string stage_in_progress()
{
  const std::lock_guard lock(in_progress().access);
  return in_progress().names.empty() ? "" : in_progress().names.back();
}

StageTimer::StageTimer(RunContext &s, std::string name)
    : run(s), stage(std::move(name)), start(std::chrono::steady_clock::now())
{
  const std::lock_guard lock(in_progress().access);
  in_progress().names.push_back(stage);
}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  run.times.push_back({stage, elapsed.count(), work.processor_seconds(), cached, work.factorisations()});
  if (std::uncaught_exceptions() > 0)
    return;
  const std::lock_guard lock(in_progress().access);
  auto &names = in_progress().names;
  names.erase(std::next(std::find(names.rbegin(), names.rend(), stage)).base());
}

namespace {
// A stage that factorises nothing has no list.
void add_timings(json &manifest, const std::vector<StageTime> &times)
{
  for (const StageTime &time : times) {
    json stage{{"stage", time.stage},
               {"seconds", time.seconds},
               {"processor_seconds", time.processor_seconds},
               {"cached", time.cached}};
    for (const Factorisation &f : time.factorisations)
      stage["factorisations"].push_back(
          {{"order", f.order}, {"nonzeros", f.nonzeros}, {"flops", f.flops}, {"times", f.times}});
    manifest["timings"].push_back(stage);
  }
}

// Files that a run reads in addition to the case.
std::vector<std::string> input_files(const Case &the_case, const std::string &force_file)
{
  std::vector<std::string> files;
  const auto add_record = [&](const std::string &file) {
    files.push_back(file);
    std::filesystem::path units = file;  // rate and units of a numpy array are in a file next to it
    units.replace_extension(".json");
    std::error_code ignored;
    if (std::filesystem::path(file).extension().string().rfind(".np", 0) == 0 &&
        std::filesystem::is_regular_file(units, ignored))
      files.push_back(units.string());
  };
  add_record(force_file);
  for (const Pass &pass : all_passes(the_case)) {
    add_record(pass.force_file);
    add_record(pass.measured_file);
  }
  if (const auto more = run_kind(the_case).files)
    for (const std::string &file : more(the_case))
      files.push_back(file);
  files.erase(std::remove(files.begin(), files.end(), ""), files.end());
  return files;
}
}  // namespace

std::string run_id_of(const Case &the_case, const std::string &verb, const std::string &force_file)
{
  std::string all = version() + "\n" + verb + "\n" + the_case.resolved;
  for (const std::string &file : input_files(the_case, force_file))
    all += "\n" + hash_of(read_text(file));
  return hash_of(all);
}

std::string manifest_json(const RunContext &run)
{
  const Case &c = run.the_case;
  json manifest{{"program", "millstand"},
                {"version", version()},
                {"case", c.name},
                {"case_path", valid_text(c.path)},
                {source_location, location_of(c.path)},
                {"kind", c.kind},
                {"title", c.title},
                {"run_id", run.out.run_id()},
                {"date", run.started},
                {"threads", run.threads},
                {"blas", blas_in_use()},
                {"versions",
                 {{"deal.II", fem::library_version()},
                  {"Gmsh", meshes::library_version()},
                  {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                                std::to_string(EIGEN_MINOR_VERSION)},
                  {"compiler", __VERSION__}}}};
  std::vector<SpeedVerdict> verdicts = run.results.speeds;
  worst_first(verdicts);
  for (const SpeedVerdict &verdict : verdicts)
    manifest["critical_speed"].push_back(json_of(verdict));
  add_timings(manifest, run.times);
  for (const auto &[file, sum] : run.out.checksums())
    manifest["files"][file] = sum;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  manifest["peak_memory"] = 1024. * double(usage.ru_maxrss);
  if (const auto describe = run_kind(c).describe)
    describe(c, manifest);
  return manifest.dump(2) + "\n";
}
}  // namespace mill
