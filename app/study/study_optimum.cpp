#include "app/study/study_optimum.h"
#include "app/process/console.h"
#include "app/run/run_setup.h"
#include "app/run/scratch_folder.h"
#include "app/study/computed_row.h"
#include "app/study/earlier_ends.h"
#include "core/base/short_number.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace mill {
namespace {
const char *const search_shard = "search";

using KeptRows = std::unordered_map<std::int64_t, FinishedRow>;

KeptRows kept_rows(const Study &study)
{
  KeptRows kept;
  auto files = row_files(study.folder, search_shard);
  files.push_back(merged_file(study.folder));
  for (const std::string &file : files)
    read_rows(file, 0, [&](FinishedRow &&row) { kept.emplace(row.key, std::move(row)); });
  return kept;
}

std::size_t place_of_objective(const Study &study)
{
  const auto entry = std::find_if(study.watched.begin(), study.watched.end(),
                                  [&](const WatchedResult &result) { return result.name == study.objective; });
  return std::size_t(entry - study.watched.begin());
}

SearchSettings settings_of(const Study &study)
{
  SearchSettings settings;
  for (const UncertainKey &key : study.keys) {
    settings.low.push_back(key.spread.low);
    settings.high.push_back(key.spread.high);
  }
  settings.greatest      = study.greatest;
  settings.search_valley = study.model == ModelKind::quick;  // not by seconds: rows are the same on every machine
  return settings;
}

std::vector<TriedRow> starts_of(const Study &study, const StudyRows &rows)
{
  const std::size_t objective = place_of_objective(study);
  std::vector<TriedRow> starts;
  for (std::size_t i = 0; i < rows.design.size(); ++i)
    starts.push_back({rows.design[i].numbers, rows.results[i].empty() ? not_given : rows.results[i][objective]});
  return starts;
}

// Key of the row with these inputs; nothing where the case refuses them.
std::optional<std::int64_t> key_of_inputs(const Study &study, const std::vector<double> &inputs)
{
  try {
    return row_key_of(study, inputs);
  } catch (const SystemError &) {
    throw;
  } catch (const InputError &) {
    return {};
  }
}

struct SearchEnded {};

// Computes and keeps the rows of a search.
class SearchWorker {
public:
  SearchWorker(const Study &asked, RowModel &row_model, const CutSignal &cut, const bool is_quiet)
      : study(asked), model(row_model), signal(cut), quiet(is_quiet), objective(place_of_objective(asked)),
        kept(kept_rows(asked)), ends(earlier_ends(asked.folder, search_shard)),
        file(new_row_file(asked.folder, search_shard))
  {
    mark_own_crash(crash_mark(file.path()));
  }

  double value(const std::vector<double> &inputs)
  {
    const auto key = key_of_inputs(study, inputs);
    if (!key)
      return not_given;
    auto row = kept.find(*key);
    if (row == kept.end()) {
      if (signal.asked())
        throw SearchEnded();
      row = kept.emplace(*key, computed(*key, inputs)).first;
    }
    return row->second.results.empty() ? not_given : row->second.results[objective];
  }

  long n_computed = 0;

private:
  FinishedRow computed(const std::int64_t key, const std::vector<double> &inputs)
  {
    const auto earlier       = ends.find(key);
    const EarlierEnds before = earlier == ends.end() ? EarlierEnds() : earlier->second;
    FinishedRow row;
    if (gives_up(before)) {
      row.key     = key;
      row.failure = sentence_of(before);
    } else {
      file.commit({}, {{key, before.all + 1}});
      row = computed_row(model, study, {0, 0, key, inputs});
    }
    file.commit({row}, {});
    ++n_computed;
    if (!quiet && n_computed % 10 == 0)
      console::print(fmt::format("search: {} rows, {} = {}\n", n_computed, study.objective,
                                 row.results.empty() ? "failed" : short_number(row.results[objective], 5)));
    return row;
  }

  const Study &study;
  RowModel &model;
  const CutSignal &signal;
  bool quiet;
  std::size_t objective;
  KeptRows kept;
  std::map<std::int64_t, EarlierEnds> ends;
  RowFile file;
};
}  // namespace

int run_search(const Study &study, const CommandLine &command, const CutSignal &signal)
{
  const StudyRows rows = study_rows(study);
  const Case base      = base_case(study);
  const ScratchFolder scratch("millstand-search");
  const OutputDir out(scratch.path(), base, true, "study");
  RunContext setup{base, out, cache_folder(command, study.folder + "/" + usual_cache)};
  open_cache(setup, out.staging());
  set_up_threads(setup, command);
  RowModel model(
      {study.model, setup.cache, command.fresh, setup.threads, cache_limit(command), command.study.keep});
  model.choose_work(study.work);
  SearchWorker worker(study, model, signal, command.quiet);
  try {
    search_optimum(settings_of(study), starts_of(study, rows),
                   [&](const std::vector<double> &inputs) { return worker.value(inputs); });
  } catch (const SearchEnded &) {
    return 128 + signal.asked();
  }
  return 0;
}

std::optional<StoredOptimum> stored_optimum(const Study &study, const StudyRows &rows)
{
  const KeptRows kept         = kept_rows(study);
  const std::size_t objective = place_of_objective(study);
  StoredOptimum stored;
  const auto kept_value = [&](const std::vector<double> &inputs) {
    const auto key = key_of_inputs(study, inputs);
    const auto row = key ? kept.find(*key) : kept.end();
    if (key && row == kept.end())
      throw SearchEnded();
    stored.results.push_back(key ? row->second.results : std::vector<double>());
    stored.failures.push_back(!key ? "the case refuses these inputs" : row->second.failure);
    return stored.results.back().empty() ? not_given : stored.results.back()[objective];
  };
  try {
    stored.optimum = search_optimum(settings_of(study), starts_of(study, rows), kept_value);
  } catch (const SearchEnded &) {
    return {};
  }
  if (const auto key = key_of_inputs(study, stored.optimum.best.inputs))
    if (const auto row = kept.find(*key); row != kept.end())
      stored.best_results = row->second.results;
  return stored;
}
}  // namespace mill
