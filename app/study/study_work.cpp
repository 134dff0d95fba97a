#include "app/study/study_work.h"
#include "app/process/console.h"
#include "app/process/cut_signal.h"
#include "app/process/fast_blas.h"
#include "app/run/run_setup.h"
#include "app/run/scratch_folder.h"
#include "app/study/computed_row.h"
#include "app/study/earlier_ends.h"
#include "app/study/store/row_files.h"
#include "app/study/study_folder.h"
#include "app/verbs/checked_case.h"
#include "core/base/digits.h"
#include "core/model/case.h"
#include "core/process/parallel.h"
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <map>
#include <set>

namespace mill {
namespace {
constexpr std::size_t most_block  = 4096;
constexpr double seconds_of_block = 0.25;  // a crash costs no more

struct Shard {
  long number = 1, of = 1;
  std::string name() const
  {
    return fmt::format("{}-of-{}", number, of);
  }
};

// "3/8"
Shard shard_of(const std::string &written)
{
  Shard shard;
  const auto slash     = written.find('/');
  const auto is_number = [](const std::string &text) { return text.size() < 10 && is_digits(text); };
  if (slash == std::string::npos || !is_number(written.substr(0, slash)) || !is_number(written.substr(slash + 1)))
    throw InputError("--shard " + written + " is not of the form I/N, for example 1/4");
  shard.number = std::stol(written.substr(0, slash));
  shard.of     = std::stol(written.substr(slash + 1));
  if (shard.number < 1 || shard.number > shard.of)
    throw InputError(fmt::format("--shard {}: the shards of {} are 1/{} to {}/{}", written, shard.of, shard.of,
                                 shard.of, shard.of));
  return shard;
}

// Keys of rows that are over, sorted: eight bytes for each of a million rows.
std::vector<std::int64_t> finished_keys(const std::string &folder, const Shard &shard)
{
  std::vector<std::int64_t> keys;
  auto files = row_files(folder, shard.name());
  files.push_back(merged_file(folder));
  for (const std::string &file : files) {
    const ReadRows read = read_rows(file, 0, [&](FinishedRow &&row) { keys.push_back(row.key); });
    if (read.damaged > 0 || !read.fault.empty())
      console::say(fmt::format("warning: {}: {} damaged, computed again\n", file,
                               read.fault.empty() ? fmt::format("{} rows", read.damaged) : "the end is"));
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

// The loop over the rows of a shard.
class Worker {
public:
  Worker(const Study &asked, RowModel &row_model, const Shard &shard, const int n_threads, const bool is_quiet)
      : study(asked), model(row_model), threads(n_threads), file(new_row_file(asked.folder, shard.name())),
        bar({{"rows", 1}}, is_quiet), ends(earlier_ends(asked.folder, shard.name()))
  {
    mark_own_crash(crash_mark(file.path()));
  }

  /// @return false: asked to end
  bool work(const std::vector<DesignRow> &rows, const CutSignal &signal)
  {
    std::size_t done = 0, size = 1;
    while (done < rows.size()) {
      if (signal.asked()) {
        file.commit(finished, {});
        return false;
      }
      const std::vector<DesignRow> block = next_block(rows, done, size);
      const auto start                   = std::chrono::steady_clock::now();
      compute(block);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (study.model == ModelKind::quick && seconds < 0.5 * seconds_of_block)
        size = std::min(2 * size, most_block);
      else if (seconds > seconds_of_block)
        size = std::max<std::size_t>(1, size / 2);
      bar.show("rows", double(done) / double(rows.size()));
    }
    file.commit(finished, {});
    bar.finish();
    return true;
  }

private:
  // Rows that were begun once before are computed one by one, so that the one that ends the program is known.
  std::vector<DesignRow> next_block(const std::vector<DesignRow> &rows, std::size_t &done, const std::size_t size)
  {
    std::vector<DesignRow> block;
    std::map<std::int64_t, int> started;
    while (done < rows.size() && block.size() < size) {
      const DesignRow &row     = rows[done];
      const auto earlier       = ends.find(row.key);
      const EarlierEnds before = earlier == ends.end() ? EarlierEnds() : earlier->second;
      const bool suspicious    = before.all > 0;
      if (suspicious && !block.empty())
        break;
      ++done;
      if (gives_up(before)) {
        finished.push_back({row.key, {}, sentence_of(before)});
        continue;
      }
      started[row.key] = before.all + 1;
      block.push_back(row);
      if (suspicious)
        break;
    }
    file.commit(finished, started);
    finished.clear();
    return block;
  }

  void compute(const std::vector<DesignRow> &block)
  {
    const std::size_t before = finished.size();
    finished.resize(before + block.size());
    const auto one = [&](const long i) {
      finished[before + std::size_t(i)] = computed_row(model, study, block[std::size_t(i)]);
    };
    if (study.model == ModelKind::quick)
      share_tasks(long(block.size()), threads, one);
    else
      for (std::size_t i = 0; i < block.size(); ++i)
        one(long(i));
  }

  const Study &study;
  RowModel &model;
  int threads;
  RowFile file;
  console::ProgressBar bar;
  std::map<std::int64_t, EarlierEnds> ends;
  std::vector<FinishedRow> finished;
};

// Rows of the shard that are not over; of rows with one key the first.
std::vector<DesignRow> open_rows(const Study &study, const Shard &shard)
{
  const auto keys       = finished_keys(study.folder, shard);
  const auto [from, to] = shard_places(study, shard.number, shard.of);
  std::vector<DesignRow> rows;
  std::set<std::int64_t> taken;
  read_design(study, from, to, [&](DesignRow &&row) {
    if (!std::binary_search(keys.begin(), keys.end(), row.key) && taken.insert(row.key).second)
      rows.push_back(std::move(row));
  });
  return rows;
}
}  // namespace

int study_work(const CommandLine &command)
{
  const Shard shard = shard_of(command.study.shard);
  const Study study = read_study(command.target);
  const Case base   = base_case(study);
  if (study.model == ModelKind::full)
    use_fast_blas(command.arguments);
  const CutSignal signal;
  const auto rows = open_rows(study, shard);
  if (rows.empty()) {
    if (!command.quiet)
      console::print(
          fmt::format("shard {}/{} of {}: all rows are finished\n", shard.number, shard.of, study.folder));
    return 0;
  }
  const ScratchFolder scratch("millstand-study");
  const OutputDir out(scratch.path(), base, true, "study");
  RunContext setup{base, out, cache_folder(command, study.folder + "/cache")};
  open_cache(setup, out.staging());
  set_up_threads(setup, command);
  RowModel model(
      {study.model, setup.cache, command.fresh, setup.threads, cache_limit(command), command.study.keep});
  model.choose_work(study.work);
  Worker worker(study, model, shard, setup.threads, command.quiet);
  if (worker.work(rows, signal)) {
    if (!command.quiet)
      console::print(
          fmt::format("shard {}/{} of {}: {} rows computed\n", shard.number, shard.of, study.folder, rows.size()));
    return 0;
  }
  console::say(
      fmt::format("stopped; what is finished is kept. Continue with: millstand study work {} --shard {}/{}\n",
                  study.folder, shard.number, shard.of));
  return 128 + signal.asked();
}
}  // namespace mill
