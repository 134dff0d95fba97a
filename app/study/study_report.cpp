#include "app/study/study_report.h"
#include "app/process/console.h"
#include "app/run/output_dir.h"
#include "app/study/store/row_files.h"
#include "app/study/study_document.h"
#include "app/study/study_optimum.h"
#include "app/study/study_statistics.h"
#include "app/study/study_table.h"
#include "core/base/files.h"
#include "core/base/short_number.h"
#include "core/base/si_unit.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include "core/records/csv.h"
#include "report/study/study_page.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

namespace mill {
namespace {
constexpr double most_failed = 0.05;

bool has_words(const UncertainKey &key)
{
  return !key.key.values.empty();
}

// results.csv
std::string csv_of(const Study &study, const StudyRows &rows)
{
  std::string text = "row,key";
  for (const UncertainKey &key : study.keys)
    text += "," + column_head(key.key.name, key.key.unit);
  for (const WatchedResult &result : study.watched)
    text += "," + column_head(result.name, result.unit);
  text += ",failure\n";
  for (std::size_t i = 0; i < rows.design.size(); ++i) {
    if (rows.results[i].empty() && rows.failures[i].empty())
      continue;  // not computed yet
    text += fmt::format("{},{:016x}", rows.design[i].row, std::uint64_t(rows.design[i].key));
    for (std::size_t k = 0; k < study.keys.size(); ++k)
      text += "," + (has_words(study.keys[k]) ? quoted_cell(set_value(study.keys[k], rows.design[i].numbers[k]))
                                              : number_text(rows.design[i].numbers[k]));
    for (std::size_t r = 0; r < study.watched.size(); ++r)
      text += "," + (rows.results[i].empty() ? std::string() : number_text(rows.results[i][r]));
    text += "," + (rows.failures[i].empty() ? std::string() : quoted_cell(rows.failures[i])) + "\n";
  }
  return text;
}

// The rows of a search behind those of the design, in the order in which they were asked for.
void append_search(const Study &study, StudyRows &rows)
{
  if (study.method != StudyMethod::optimise)
    return;
  const auto stored = stored_optimum(study, rows);
  if (!stored)
    return;
  for (std::size_t i = 0; i < stored->optimum.tried.size(); ++i) {
    DesignRow row;
    row.row = study.rows + std::int64_t(i) + 1;
    if (!stored->results[i].empty())
      row.key = row_key_of(study, stored->optimum.tried[i].inputs);
    row.numbers = stored->optimum.tried[i].inputs;
    rows.design.push_back(row);
    rows.results.push_back(stored->results[i]);
    rows.failures.push_back(stored->failures[i]);
  }
}

void merge(const Study &study)
{
  for (const std::string &note : merge_rows(study.folder))
    console::say("warning: " + note + "\n");
}

std::string with_interval(const nlohmann::ordered_json &e)
{
  const auto number = [](const nlohmann::ordered_json &value) {
    return value.is_number() ? value.get<double>() : not_given;
  };
  const std::string value = fmt::format("{:>11}", short_number(number(e["value"]), 5));
  if (!std::isfinite(number(e["low"])) || !std::isfinite(number(e["high"])))  // the same in every row
    return value;
  return value + fmt::format(" ({} .. {})", short_number(number(e["low"]), 5), short_number(number(e["high"]), 5));
}

// Key with the largest share of the variance, and that share.
std::string first_to_measure(const nlohmann::ordered_json &document, const nlohmann::ordered_json &result)
{
  const nlohmann::ordered_json &shares = result.contains("sobol")   ? result["sobol"]["first"]
                                         : result.contains("chaos") ? result["chaos"]["first"]
                                                                    : result["statistics"]["shares"];
  if (shares.empty())
    return "";
  std::size_t first = 0;
  double largest    = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (shares[k].is_number() && shares[k].get<double>() > largest) {
      first   = k;
      largest = shares[k].get<double>();
    }
  if (!std::isfinite(largest))
    return "";
  return fmt::format("{} ({:.0f} %)", document["keys"][first]["name"].get<std::string>(), 100 * largest);
}

std::string chaos_text(const nlohmann::ordered_json &chaos)
{
  const auto percent = [&](const char *name) {
    return chaos[name].is_number() ? fmt::format("{:.2g} %", 100 * chaos[name].get<double>()) : std::string("-");
  };
  return fmt::format(
      "  polynomial of degree {} with {} terms: leave-one-out error {} of the variance, {} of {} rows "
      "that were held out\n",
      chaos["degree"].get<int>(), chaos["terms"].get<int>(), percent("leave_one_out"), percent("held_out"),
      chaos["held_out_rows"].get<long>());
}

std::string optimum_text(const nlohmann::ordered_json &document)
{
  const nlohmann::ordered_json &optimum = document["optimum"];
  if (optimum.is_null())
    return "the search is not over; continue it with: millstand study run\n";
  std::string text = fmt::format(
      "{} of {}: {} at", optimum["searched"].get<std::string>(), optimum["objective"].get<std::string>(),
      optimum["value"].is_number() ? short_number(optimum["value"].get<double>(), 5) : "-");
  for (std::size_t k = 0; k < document["keys"].size(); ++k)
    text += fmt::format("{} {} = {} {}{}", k > 0 ? "," : "", document["keys"][k]["name"].get<std::string>(),
                        short_number(optimum["inputs"][k].get<double>(), 4),
                        document["keys"][k]["unit"].get<std::string>(),
                        optimum["at_bound"][k].get<bool>() ? " (bound)" : "");
  return text + fmt::format("; {} rows searched\n", optimum["rows"].get<long>());
}

std::string summary_text(const nlohmann::ordered_json &document)
{
  std::string text = document.contains("optimum") ? optimum_text(document) : "";
  for (const nlohmann::ordered_json &result : document["results"]) {
    if (!result.contains("statistics"))
      continue;
    const nlohmann::ordered_json &s = result["statistics"];
    const std::string first         = first_to_measure(document, result);
    text += fmt::format(
        "{} [{}]: mean {}, sd {}, 95 % of the rows {} .. {}{}\n", result["name"].get<std::string>(),
        result["unit"].get<std::string>(), with_interval(s["mean"]), with_interval(s["sd"]),
        short_number(s["q025"]["value"].get<double>(), 5), short_number(s["q975"]["value"].get<double>(), 5),
        first.empty() ? "" : "; largest share of the variance: " + first);
    if (result.contains("linear"))
      text += fmt::format("  by derivatives at the means: sd {}\n",
                          short_number(result["linear"]["sd"].get<double>(), 5));
    if (result.contains("chaos"))
      text += chaos_text(result["chaos"]);
  }
  return visible(text);
}
}  // namespace

int study_status(const CommandLine &command)
{
  const Study study = read_study(command.target);
  std::set<std::int64_t> finished;
  long failed = 0, begun = 0;
  const auto read_file = [&](const std::string &file) {
    read_rows(file, 0, [&](FinishedRow &&row) {
      if (finished.insert(row.key).second && !row.failure.empty())
        ++failed;
    });
  };
  read_file(merged_file(study.folder));
  for (const std::string &file : row_files(study.folder)) {
    read_file(file);
    begun += long(begun_rows(file).size());
  }
  long rows = 0;
  std::set<std::int64_t> open;
  read_design(study, 0, study.rows, [&](DesignRow &&row) {
    if (finished.count(row.key))
      ++rows;
    else
      open.insert(row.key);
  });
  console::print(
      fmt::format("{}: {} by {}, {}\n{} of {} rows finished ({:.1f} %), {} of them failed; {} open, {} of them "
                  "begun\n{} files of workers\n",
                  study.folder, study.case_name, word_of(study.method), study.work, rows, study.rows,
                  100 * double(rows) / double(std::max(1L, study.rows)), failed, open.size(), begun,
                  row_files(study.folder).size()));
  if (study.method == StudyMethod::optimise)
    console::print(fmt::format("{} rows searched\n", std::max(0L, long(finished.size()) - rows)));
  return 0;
}

int study_merge(const CommandLine &command)
{
  const Study study = read_study(command.target);
  merge(study);
  StudyRows rows = study_rows(study);
  append_search(study, rows);
  write_atomically(study.folder + "/results.csv", csv_of(study, rows));
  if (!command.quiet)
    console::print(fmt::format("{}/results.csv: {} of {} rows\n", study.folder, rows.finished, study.rows));
  return 0;
}

int study_report(const CommandLine &command)
{
  const Study study = read_study(command.target);
  merge(study);
  const StudyRows rows = study_rows(study);
  if (rows.finished == 0)
    throw InputError("no row of " + study.folder + " is finished; start them with: millstand study run " +
                     study.folder);
  if (double(rows.failed) > most_failed * double(rows.finished) && !command.study.allow_failed)
    throw InputError(
        fmt::format("{} of {} finished rows failed, more than 5 %: statistics of the others would mislead; "
                    "'millstand study merge {}' lists the reasons, --allow-failed takes the others",
                    rows.failed, rows.finished, study.folder));
  const nlohmann::ordered_json document = study_document(study, rows);
  StudyRows all                         = rows;
  append_search(study, all);
  const std::string text = document.dump(1) + "\n";
  replace_results(study.folder, {"report.json", "results.csv", "report.html"}, [&](const std::string &staged) {
    write_atomically(staged + "/results.csv", csv_of(study, all));
    write_atomically(staged + "/report.html", report::study_page(study.folder, text));
    write_atomically(staged + "/report.json", text);
  });
  if (!command.quiet)
    console::print(summary_text(document) + "report: " + study.folder + "/report.html\n");
  return 0;
}
}  // namespace mill
