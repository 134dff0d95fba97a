#include "app/study/study_document.h"
#include "app/study/analysis_program.h"
#include "app/study/json_number.h"
#include "app/study/linear_estimate.h"
#include "app/study/study_optimum.h"
#include "core/records/search_goal.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
constexpr std::size_t most_scatter  = 2000;  // points of a drawing
constexpr std::size_t most_failures = 100;

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

// Rows of the design that are drawings of the inputs: of Saltelli's the groups A and B.
long sample_rows(const Study &study)
{
  return study.method == StudyMethod::sobol ? 2 * study.samples : 0;
}

nlohmann::ordered_json linear_json(const LinearEstimate &estimate)
{
  return {{"sd", json_number(estimate.sd)}, {"shares", estimate.shares}};
}

// Inputs and results of all rows as the analysis program takes them.
struct Columns {
  std::vector<std::vector<double>> inputs, results;
};

Columns columns_of(const Study &study, const StudyRows &rows)
{
  Columns columns;
  columns.results.resize(study.watched.size());
  for (std::size_t i = 0; i < rows.design.size(); ++i) {
    columns.inputs.push_back(rows.design[i].numbers);
    for (std::size_t r = 0; r < columns.results.size(); ++r)
      columns.results[r].push_back(rows.results[i].empty() ? not_given : rows.results[i][r]);
  }
  return columns;
}

nlohmann::ordered_json optimum_json(const Study &study, const StudyRows &rows)
{
  const auto stored = stored_optimum(study, rows);
  if (!stored)
    return {};
  const Optimum &optimum        = stored->optimum;
  nlohmann::ordered_json valley = nlohmann::ordered_json::array();
  for (const auto &of_key : optimum.valley) {
    valley.push_back(nlohmann::ordered_json::array());
    for (const ValleyPoint &point : of_key)
      valley.back().push_back({{"inputs", point.inputs}, {"value", json_number(point.value)}});
  }
  nlohmann::ordered_json path = nlohmann::ordered_json::array();
  for (const TriedRow &tried : optimum.tried)
    path.push_back(json_number(tried.value));
  return {{"objective", study.objective},
          {"searched", word_of(study.greatest ? SearchGoal::greatest : SearchGoal::least)},
          {"inputs", optimum.best.inputs},
          {"value", json_number(optimum.best.value)},
          {"at_bound", optimum.at_bound},
          {"results", stored->best_results},
          {"rows", optimum.tried.size()},
          {"searched_valley", optimum.searched_valley},
          {"valley", valley},
          {"path", path}};
}

void add_statistics(const Study &study, const StudyRows &rows, nlohmann::ordered_json &results)
{
  std::vector<IndicesOfResult> sobol;
  nlohmann::ordered_json chaos;
  if (study.method == StudyMethod::sobol || study.method == StudyMethod::chaos) {
    const Columns columns = columns_of(study, rows);
    if (study.method == StudyMethod::sobol)
      sobol = indices_of(columns.inputs, columns.results, study.samples);
    else
      chaos = chaos_of(study, columns.inputs, columns.results, study.samples);
  }
  for (std::size_t r = 0; r < study.watched.size(); ++r) {
    nlohmann::ordered_json &result = results[r];
    result["statistics"]           = statistics_json(statistics_of(study, rows, r, sample_rows(study)));
    if (const LinearEstimate linear = linear_estimate(study, study.watched[r]); !linear.shares.empty())
      result["linear"] = linear_json(linear);
    if (!sobol.empty() && !sobol[r].first.empty())
      result["sobol"] = indices_json(sobol[r]);
    if (!chaos.empty() && !chaos[r].is_null())
      result["chaos"] = chaos[r];
  }
}
}  // namespace

nlohmann::ordered_json study_document(const Study &study, const StudyRows &rows)
{
  nlohmann::ordered_json document{{"schema", 1},
                                  {"case", study.case_name},
                                  {"case_path", study.case_path},
                                  {"title", study.title},
                                  {"method", word_of(study.method)},
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
  const auto step = std::max<std::size_t>(1, rows.design.size() / most_scatter);
  for (std::size_t r = 0; r < study.watched.size(); ++r) {
    const WatchedResult &watched = study.watched[r];
    nlohmann::ordered_json result{{"name", watched.name},
                                  {"unit", watched.unit},
                                  {"meaning", watched.meaning},
                                  {"base", json_number(watched.base)},
                                  {"error_estimate", json_number(watched.error_estimate)}};
    document["results"].push_back(result);
  }
  if (study.method == StudyMethod::optimise)
    document["optimum"] = optimum_json(study, rows);
  else if (study.method != StudyMethod::grid && study.method != StudyMethod::list)
    add_statistics(study, rows, document["results"]);
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
}  // namespace mill
