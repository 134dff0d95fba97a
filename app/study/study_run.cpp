#include "app/study/study_run.h"
#include "app/process/console.h"
#include "app/process/cut_signal.h"
#include "app/study/started_program.h"
#include "app/study/store/row_files.h"
#include "app/study/study_optimum.h"
#include "app/study/worker_processes.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

namespace fs = std::filesystem;

namespace mill {
namespace {
constexpr double seconds_of_shard = 20;
constexpr long shards_of_core     = 10;

// A word of the shell, whatever it holds.
std::string shell_word(const std::string &text)
{
  if (has_any(text, "\n\r"))
    throw InputError("the folder " + text + " has a line feed in its name; no engine can start there");
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

long processors()
{
  return long(std::max(1u, std::thread::hardware_concurrency()));
}

std::string absolute_folder(const Study &study)
{
  return fs::absolute(study.folder).lexically_normal().string();
}

bool is_installed(const std::string &program)
{
  const char *path = std::getenv("PATH");
  std::string folder;
  for (const char *c = path ? path : "";; ++c) {
    if (*c == ':' || *c == '\0') {
      std::error_code ignored;
      if (!folder.empty() && fs::exists(folder + "/" + program, ignored))
        return true;
      folder.clear();
      if (*c == '\0')
        return false;
    } else {
      folder += *c;
    }
  }
}

void require_engine(const StudyEngine engine)
{
  if (engine == StudyEngine::parallel && !is_installed("parallel"))
    throw InputError("--engine parallel needs GNU parallel, which is not installed: apt-get install parallel; "
                     "--engine here works without it");
  if (engine == StudyEngine::slurm && !is_installed("sbatch"))
    throw InputError("--engine slurm needs sbatch, which is not installed on this machine: apt-get install "
                     "slurm-client; --engine here works without it");
}

// What is common to the calls of all shards.
std::string options_of(const CommandLine &command)
{
  std::string options = " -q";
  if (command.threads > 0)
    options += fmt::format(" --threads {}", command.threads);
  if (!command.cache.empty())
    options += " --cache " + shell_word(fs::absolute(command.cache).string());
  if (cache_limit(command) > 0)
    options += " --cache-limit " + shell_word(command.sweep.cache_limit);
  if (!command.memory.empty())
    options += " --memory " + shell_word(command.memory);
  if (command.study.keep)
    options += " --keep";
  return options;
}

void say_notes(const std::vector<std::string> &notes)
{
  for (const std::string &note : notes)
    console::say("warning: " + note + "\n");
}

// The script of an engine, for whoever wants to see what was started.
std::string written_script(const Study &study, const StudyEngine engine, const std::string &script)
{
  const std::string file = study.folder + "/" + word_of(engine) + ".sh";
  write_atomically(file, script);
  return file;
}

// Rows that are not over; the files are read as they are, since merging a million rows takes longer.
long open_rows_of(const Study &study)
{
  std::vector<std::int64_t> keys;
  auto files = row_files(study.folder);
  files.push_back(merged_file(study.folder));
  for (const std::string &file : files)
    read_rows(file, 0, [&](FinishedRow &&row) { keys.push_back(row.key); });
  std::sort(keys.begin(), keys.end());
  long open = 0;
  read_design(study, 0, study.rows,
              [&](DesignRow &&row) { open += !std::binary_search(keys.begin(), keys.end(), row.key); });
  return open;
}

// A worker reads the files of its own shard and what is merged: shards that were cut in another way are merged
// first.
void merge_other_shards(const Study &study, const long shards)
{
  const std::string same = fmt::format("-of-{}-", shards);
  const auto files       = row_files(study.folder);
  if (std::any_of(files.begin(), files.end(),
                  [&](const std::string &file) { return file.find(same) == std::string::npos; }))
    say_notes(merge_rows(study.folder));
}
}  // namespace

long shards_for(const Study &study, const long cores)
{
  const double total = std::isfinite(study.seconds) ? study.seconds * double(study.rows) : 0;
  const long by_time = long(total / seconds_of_shard);
  return std::clamp(by_time, std::min(cores, study.rows),
                    std::max(shards_of_core * cores, std::min(by_time, study.rows)));
}

std::string engine_script(const Study &study, const StudyEngine engine, const long shards,
                          const CommandLine &command, const std::string &program)
{
  const std::string folder = absolute_folder(study);
  const std::string work   = shell_word(program) + " study work " + shell_word(folder) + " --shard ";
  if (engine == StudyEngine::slurm)
    return fmt::format("#!/bin/sh\n#SBATCH --job-name=millstand\n#SBATCH --array=1-{}\n#SBATCH --requeue\n"
                       "#SBATCH --open-mode=append\n#SBATCH --signal=B:TERM@60\n#SBATCH --output={}/slurm-%a.log\n"
                       "exec {}\"$SLURM_ARRAY_TASK_ID\"/{}{}\n",
                       shards, folder, work, shards, options_of(command));
  const long jobs              = command.study.jobs > 0 ? command.study.jobs : processors();
  const std::string shard_file = shell_word(folder + "/parallel.shards");
  const std::string hosts      = command.study.hosts.empty()
                                     ? ""
                                     : " --sshloginfile " + shell_word(fs::absolute(command.study.hosts).string());
  const std::string threads    = command.threads > 0 ? "" : " --threads 1";
  // By exec it has the process number that `study run` ends; its workers have ten seconds for what is under way.
  return fmt::format("#!/bin/sh\nseq {} > {}\nexec parallel --arg-file {} --jobs {} --retries 3 --halt never \\\n"
                     "  --termseq TERM,10000,KILL,25{} --joblog {} \\\n  {}\n",
                     shards, shard_file, shard_file, jobs, hosts, shell_word(folder + "/parallel.log"),
                     shell_word(work + "{}/" + std::to_string(shards) + options_of(command) + threads));
}

int study_run(const CommandLine &command)
{
  const Study study        = read_study(command.target);
  const StudyEngine engine = choice_named<StudyEngine>(command.study.engine).value();
  const long jobs = command.study.jobs > 0 ? command.study.jobs : engine == StudyEngine::here ? 1 : processors();
  if (command.study.dry_run && engine == StudyEngine::here) {
    console::print(fmt::format("millstand study work {} --shard I/{}, {} at a time\n", study.folder, jobs, jobs));
    return 0;
  }
  if (engine == StudyEngine::here && !command.study.hosts.empty())
    throw InputError("--hosts belongs to --engine parallel");
  const long shards = engine == StudyEngine::slurm ? jobs : shards_for(study, jobs);
  if (command.study.dry_run) {
    console::print(engine_script(study, engine, shards, command, program_path("millstand")));
    return 0;
  }
  require_engine(engine);
  if (!command.study.hosts.empty())
    read_text(command.study.hosts);  // one that cannot be read is named here, not by every worker
  base_case(study);
  const long open = open_rows_of(study);
  if (open == 0 && study.method != StudyMethod::optimise) {
    if (!command.quiet)
      console::print("all rows are finished; report: millstand study report " + study.folder + "\n");
    return 0;
  }
  merge_other_shards(study, engine == StudyEngine::here ? jobs : shards);
  const std::string script =
      engine == StudyEngine::here
          ? ""
          : written_script(study, engine,
                           engine_script(study, engine, shards, command, program_path("millstand")));
  if (engine == StudyEngine::slurm) {
    if (const int failed = run_program("sbatch", {script}, "arrays of a study"))
      throw SystemError("sbatch did not accept the array; its message is above, its script " + script);
    if (!command.quiet)
      console::print("watch it with: millstand study status " + study.folder + "\n");
    return 0;
  }
  const CutSignal signal;
  RowWatch watch(study, open, command.quiet);
  int code = 0;
  if (engine == StudyEngine::here)
    code = run_workers_here(study, command, jobs, signal, watch);
  else if (wait_or_end(start_program("sh", {script}, "shards of a study"), signal, watch) != 0)
    code = signal.asked() ? 128 + signal.asked() : 3;
  watch.finish();
  say_notes(merge_rows(study.folder));
  if (code == 0 && study.method == StudyMethod::optimise) {
    code = run_search(study, command, signal);
    say_notes(merge_rows(study.folder));
  }
  if (code > 128)
    console::say("stopped; what is finished is kept. Continue with: millstand study run " + study.folder + "\n");
  else if (code == 0 && !command.quiet)
    console::print("finished; report: millstand study report " + study.folder + "\n");
  return code;
}
}  // namespace mill
