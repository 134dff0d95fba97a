#include "app/study/sweep_command.h"
#include "app/process/console.h"
#include "app/run/output_dir.h"
#include "app/run/run_setup.h"
#include "app/run/scratch_folder.h"
#include "app/study/study_table.h"
#include "app/verbs/checked_case.h"
#include "core/base/files.h"
#include "core/base/short_number.h"
#include "core/base/si_unit.h"
#include "core/base/visible_text.h"
#include "core/model/case.h"
#include "core/process/parallel.h"
#include "report/study/sweep_page.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr std::size_t most_rows = 100000, most_shown = 30, most_refused = 10;

// Every combination of values; the last key changes first.
std::vector<TableRow> combinations(const std::vector<VariedKey> &keys)
{
  std::size_t n = 1;
  for (const VariedKey &key : keys)
    if ((n *= key.values.size()) > most_rows)
      throw InputError(
          fmt::format("a sweep takes {} rows at most; take fewer values, or 'millstand study', which can "
                      "be resumed and shared among machines",
                      most_rows));
  std::vector<TableRow> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t rest = i;
    rows[i].values.resize(keys.size());
    rows[i].numbers.resize(keys.size());
    for (std::size_t k = keys.size(); k-- > 0; rest /= keys[k].values.size()) {
      rows[i].values[k]  = keys[k].values[rest % keys[k].values.size()];
      rows[i].numbers[k] = keys[k].numbers[rest % keys[k].values.size()];
    }
  }
  return rows;
}

// "row 7 (backup_roll.crown = 300 um)"
std::string row_name(const std::vector<VariedKey> &keys, const TableRow &row, const std::size_t number)
{
  std::string values;
  for (std::size_t k = 0; k < keys.size(); ++k)
    values += (k > 0 ? ", " : "") + keys[k].name + " = " + row.values[k];
  return fmt::format("row {} ({})", number, values);
}

std::vector<std::string> sets_of(const std::vector<std::string> &sets, const std::vector<VariedKey> &keys,
                                 const TableRow &row)
{
  std::vector<std::string> all = sets;
  for (std::size_t k = 0; k < keys.size(); ++k)
    all.push_back(keys[k].path + "=" + row.values[k]);
  return all;
}

// Every refused row is named before anything is computed.
void check_rows(const CommandLine &command, const std::vector<VariedKey> &keys, const std::vector<TableRow> &rows)
{
  std::vector<Problem> problems;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    try {
      checked_row(command.target, sets_of(command.sets, keys, rows[i]));
    } catch (const InputError &e) {
      if (++refused <= most_refused)
        for (Problem problem : e.problems) {
          problem.message = row_name(keys, rows[i], i + 1) + ": " + problem.message;
          problems.push_back(problem);
        }
    }
  }
  if (refused > most_refused)
    problems.push_back({{}, fmt::format("{} more rows are refused", refused - most_refused), {}});
  if (!problems.empty())
    throw InputError(problems);
}

// The case of a row is read again: a thousand of them would take more memory than time.
void compute_row(const CommandLine &command, RowModel &model, const StudyTable &table, TableRow &row)
{
  const NamedResults &watched = table.watched;
  row.results.assign(watched.size(), not_given);
  try {
    const NamedResults results =
        model.results(checked_row(command.target, sets_of(command.sets, table.keys, row)));
    for (std::size_t i = 0; i < watched.size(); ++i) {
      const auto entry = std::find_if(results.begin(), results.end(),
                                      [&](const auto &result) { return result.first == watched[i].first; });
      if (entry != results.end() && entry->second.unit == watched[i].second.unit)
        row.results[i] = entry->second.value;
      else
        row.failure = "no result " + watched[i].first;
    }
  } catch (const SolverError &e) {
    row.failure = e.report.what;
  } catch (const InputError &e) {
    row.failure = e.problems.empty() ? e.what() : e.problems.front().message;
  }
}

// Of a column: its name or its longest value.
std::size_t width_of(const VariedKey &key)
{
  std::size_t width = key.name.size();
  for (const std::string &value : key.values)
    width = std::max(width, value.size());
  return width;
}

std::string table_text(const StudyTable &table)
{
  std::string text = fmt::format("{:>5}", "row");
  for (const VariedKey &key : table.keys)
    text += fmt::format("  {:>{}}", key.name, width_of(key));
  for (const auto &[name, result] : table.watched)
    text += fmt::format("  {:>14}", name + after_name(result.unit));
  text += "\n";
  for (std::size_t i = 0; i < std::min(table.rows.size(), most_shown); ++i) {
    const TableRow &row = table.rows[i];
    text += fmt::format("{:>5}", i + 1);
    for (std::size_t k = 0; k < table.keys.size(); ++k)
      text += fmt::format("  {:>{}}", row.values[k], width_of(table.keys[k]));
    for (std::size_t r = 0; r < table.watched.size(); ++r) {
      const auto &[name, result] = table.watched[r];
      const std::size_t width    = name.size() + after_name(result.unit).size();
      text += fmt::format("  {:>{}}", std::isfinite(row.results[r]) ? short_number(row.results[r], 5) : "-",
                          std::max<std::size_t>(14, width));
    }
    text += (row.failure.empty() ? "" : "  " + row.failure) + "\n";
  }
  if (table.rows.size() > most_shown)
    text += fmt::format("  {} more in results.csv\n", table.rows.size() - most_shown);
  return visible(text);
}

void write_sweep(const std::string &folder, const StudyTable &table)
{
  const std::string json = table_json(table);
  replace_results(folder, {"sweep.json", "results.csv", "report.html"}, [&](const std::string &staged) {
    write_atomically(staged + "/results.csv", table_csv(table));
    write_atomically(staged + "/report.html", report::sweep_page(folder, json));
    write_atomically(staged + "/sweep.json", json);
  });
}

double seconds_since(const std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Closed forms side by side, runs one after the other with all threads inside.
void compute_rows(const CommandLine &command, RowModel &model, const int threads, StudyTable &table)
{
  const auto start = std::chrono::steady_clock::now();
  console::ProgressBar bar({{"rows", 1}}, command.quiet);
  const std::size_t n = table.rows.size();
  std::atomic<std::size_t> done{0};
  const auto one = [&](const long i) {
    compute_row(command, model, table, table.rows[std::size_t(i)]);
    if (const std::size_t now = ++done; 100 * now / n != 100 * (now - 1) / n)
      bar.show("rows", double(now) / double(n));
  };
  bar.show("rows", 0);
  if (choice_named<ModelKind>(command.sweep.model) == ModelKind::quick)
    share_tasks(long(n), threads, one);
  else
    for (std::size_t i = 0; i < n; ++i)
      one(long(i));
  bar.finish();
  table.seconds = seconds_since(start);
}
}  // namespace

int sweep_command(const CommandLine &command)
{
  const Case base = checked_case(command).the_case;
  StudyTable table;
  table.keys = varied_keys(base, command.sets, command.sweep.vary);
  table.rows = combinations(table.keys);
  check_rows(command, table.keys, table.rows);
  table.case_name = base.name;
  table.case_path = base.path;
  table.title     = base.title;

  const std::string folder = command.output.empty() ? "out/" + base.name + "-sweep" : command.output;
  require_result_folder(folder, "sweep.json", "sweep", command.force_overwrite);
  const ScratchFolder scratch("millstand-sweep");
  const OutputDir out(scratch.path(), base, true, "sweep");
  RunContext setup{base, out, cache_folder(command, folder + "/cache")};
  open_cache(setup, out.staging());
  set_up_threads(setup, command);
  RowModel model({choice_named<ModelKind>(command.sweep.model).value_or(ModelKind::full), setup.cache,
                  command.fresh, setup.threads, cache_limit(command)});
  table.watched = model.choose(base, command.sweep.watch);
  table.work    = model.work();
  compute_rows(command, model, setup.threads, table);
  write_sweep(folder, table);
  if (!command.quiet)
    console::print(table_text(table) + "report: " + folder + "/report.html\n");
  const bool any =
      std::any_of(table.rows.begin(), table.rows.end(), [](const TableRow &row) { return row.failure.empty(); });
  return any ? 0 : 3;
}
}  // namespace mill
