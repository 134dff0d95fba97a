#include "app/study/study_report.h"
#include "app/process/console.h"
#include "app/study/analysis_program.h"
#include "app/study/json_number.h"
#include "app/study/store/row_files.h"
#include "app/study/study_statistics.h"
#include "core/base/files.h"
#include "core/base/short_number.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include "core/records/csv.h"
#include "report/study/study_page.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace mill {
namespace {
constexpr double most_failed        = 0.05;
constexpr std::size_t most_scatter  = 2000;  // points of a drawing
constexpr std::size_t most_failures = 100;

std::string column_head(const std::string &name, const std::string &unit)
{
  const std::string text = unit.empty() || unit == "1" ? name : name + " [" + unit + "]";
  return text.find_first_of(",\";") == std::string::npos ? text : quoted_cell(text);
}

bool has_words(const UncertainKey &key)
{
  return !key.key.values.empty();
}

// results.csv row by row, so that a million rows need no memory.
void write_csv(const Study &study, const StudyRows &rows)
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
  write_atomically(study.folder + "/results.csv", text);
}

void merge(const Study &study)
{
  for (const std::string &note : merge_rows(study.folder))
    console::say("warning: " + note + "\n");
}

nlohmann::ordered_json estimated_json(const Estimated &e)
{
  return {{"value", json_number(e.value)}, {"low", json_number(e.low)}, {"high", json_number(e.high)}};
}

nlohmann::ordered_json statistics_json(const ResultStatistics &s)
{
  return {{"n", s.n},
          {"mean", estimated_json(s.mean)},
          {"sd", estimated_json(s.sd)},
          {"q025", estimated_json(s.q025)},
          {"median", estimated_json(s.median)},
          {"q975", estimated_json(s.q975)},
          {"shares", s.shares},
          {"explained", json_number(s.explained)},
          {"bin_edges", s.bin_edges},
          {"bin_shares", s.bin_shares}};
}

nlohmann::ordered_json indices_json(const IndicesOfResult &s)
{
  return {{"first", s.first},  {"first_low", s.first_low}, {"first_high", s.first_high},
          {"total", s.total},  {"total_low", s.total_low}, {"total_high", s.total_high},
          {"groups", s.groups}};
}

std::vector<IndicesOfResult> sobol_of(const Study &study, const StudyRows &rows)
{
  std::vector<std::vector<double>> inputs, results(study.watched.size());
  for (std::size_t i = 0; i < rows.design.size(); ++i) {
    inputs.push_back(rows.design[i].numbers);
    for (std::size_t r = 0; r < results.size(); ++r)
      results[r].push_back(rows.results[i].empty() ? not_given : rows.results[i][r]);
  }
  return indices_of(inputs, results, study.samples);
}

// Rows of the design that are drawings of the inputs: of Saltelli's the groups A and B.
long sample_rows(const Study &study)
{
  return study.method == "sobol" ? 2 * study.samples : 0;
}

nlohmann::ordered_json document_of(const Study &study, const StudyRows &rows)
{
  nlohmann::ordered_json document{{"schema", 1},
                                  {"case", study.case_name},
                                  {"case_path", study.case_path},
                                  {"title", study.title},
                                  {"method", study.method},
                                  {"work", study.work},
                                  {"samples", study.samples},
                                  {"rows", study.rows},
                                  {"finished", rows.finished},
                                  {"failed", rows.failed}};
  for (const UncertainKey &key : study.keys)
    document["keys"].push_back({{"name", key.key.name},
                                {"unit", key.key.unit},
                                {"meaning", key.key.meaning},
                                {"written", key.written},
                                {"sd", json_number(deviation_of(key.spread))}});
  const bool drawn = study.method != "grid" && study.method != "list";
  const auto sobol = study.method == "sobol" ? sobol_of(study, rows) : std::vector<IndicesOfResult>();
  const auto step  = std::max<std::size_t>(1, rows.design.size() / most_scatter);
  for (std::size_t r = 0; r < study.watched.size(); ++r) {
    const WatchedResult &watched = study.watched[r];
    nlohmann::ordered_json result{{"name", watched.name},
                                  {"unit", watched.unit},
                                  {"meaning", watched.meaning},
                                  {"base", json_number(watched.base)},
                                  {"error_estimate", json_number(watched.error_estimate)}};
    if (drawn)
      result["statistics"] = statistics_json(statistics_of(study, rows, r, sample_rows(study)));
    if (!sobol.empty())
      result["sobol"] = indices_json(sobol[r]);
    document["results"].push_back(result);
  }
  document["points"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < rows.design.size(); i += step)
    if (!rows.results[i].empty())
      document["points"].push_back({{"inputs", rows.design[i].numbers}, {"results", rows.results[i]}});
  document["failures"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < rows.design.size() && document["failures"].size() < most_failures; ++i)
    if (!rows.failures[i].empty())
      document["failures"].push_back({{"row", row_name(study, rows.design[i])}, {"reason", rows.failures[i]}});
  return document;
}

std::string with_interval(const nlohmann::ordered_json &e)
{
  const auto number = [](const nlohmann::ordered_json &value) {
    return value.is_number() ? value.get<double>() : not_given;
  };
  return fmt::format("{:>11} ({} .. {})", short_number(number(e["value"]), 5), short_number(number(e["low"]), 5),
                     short_number(number(e["high"]), 5));
}

// Key with the largest share of the variance, and that share.
std::string first_to_measure(const nlohmann::ordered_json &document, const nlohmann::ordered_json &result)
{
  const nlohmann::ordered_json &shares =
      result.contains("sobol") ? result["sobol"]["first"] : result["statistics"]["shares"];
  if (shares.empty())
    return "";
  const auto largest = std::max_element(shares.begin(), shares.end());
  return fmt::format("{} ({:.0f} %)",
                     document["keys"][std::size_t(largest - shares.begin())]["name"].get<std::string>(),
                     100 * largest->get<double>());
}

std::string summary_text(const nlohmann::ordered_json &document)
{
  std::string text;
  for (const nlohmann::ordered_json &result : document["results"]) {
    if (!result.contains("statistics"))
      continue;
    const nlohmann::ordered_json &s = result["statistics"];
    text +=
        fmt::format("{} [{}]: mean {}, sd {}, 95 % of the rows {} .. {}; largest share of the variance: {}\n",
                    result["name"].get<std::string>(), result["unit"].get<std::string>(), with_interval(s["mean"]),
                    with_interval(s["sd"]), short_number(s["q025"]["value"].get<double>(), 5),
                    short_number(s["q975"]["value"].get<double>(), 5), first_to_measure(document, result));
  }
  return visible(text);
}
}  // namespace

int study_status(const CommandLine &command)
{
  const Study study = read_study(command.target);
  std::set<std::int64_t> finished;
  long failed = 0, begun = 0;
  for (const std::string &file : row_files(study.folder)) {
    read_rows(file, 0, [&](FinishedRow &&row) {
      if (finished.insert(row.key).second && !row.failure.empty())
        ++failed;
    });
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
                  study.folder, study.case_name, study.method, study.work, rows, study.rows,
                  100 * double(rows) / double(std::max(1L, study.rows)), failed, open.size(), begun,
                  row_files(study.folder).size()));
  return 0;
}

int study_merge(const CommandLine &command)
{
  const Study study = read_study(command.target);
  merge(study);
  const StudyRows rows = study_rows(study);
  write_csv(study, rows);
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
  write_csv(study, rows);
  const nlohmann::ordered_json document = document_of(study, rows);
  const std::string text                = document.dump(1) + "\n";
  write_atomically(study.folder + "/report.json", text);
  write_atomically(study.folder + "/report.html", report::study_page(study.folder, text));
  if (!command.quiet)
    console::print(summary_text(document) + "report: " + study.folder + "/report.html\n");
  return 0;
}
}  // namespace mill
