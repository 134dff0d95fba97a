#include "app/study/analysis_program.h"
#include "app/run/scratch_folder.h"
#include "app/study/correlation.h"
#include "app/study/json_number.h"
#include "app/study/started_program.h"
#include "app/study/study_task.h"
#include "core/base/files.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace mill {
namespace {
std::string bytes_of(const std::vector<std::vector<double>> &rows)
{
  std::string bytes;
  for (const auto &row : rows)
    bytes.append(reinterpret_cast<const char *>(row.data()), row.size() * sizeof(double));
  return bytes;
}

// The answer of the program to the request in a folder.
nlohmann::ordered_json answer_of(const std::string &folder, const nlohmann::ordered_json &request)
{
  write_atomically(folder + "/request.json", request.dump());
  const int status = run_program(program_path("millstand-study"), {folder}, "designs and indices of a study");
  if (status != 0)
    throw SystemError("millstand-study ended with status " + std::to_string(status));
  const nlohmann::ordered_json answer = nlohmann::ordered_json::parse(read_text(folder + "/answer.json"));
  if (answer.contains("refused"))
    throw InputError(answer["refused"].get<std::string>());
  return answer["answer"];
}

// A list in which what is not finite is null.
std::vector<double> numbers_of(const nlohmann::ordered_json &list)
{
  std::vector<double> numbers;
  for (const nlohmann::ordered_json &value : list)
    numbers.push_back(value.is_number() ? value.get<double>() : not_given);
  return numbers;
}

nlohmann::ordered_json correlations_json(const Study &study)
{
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const KeyCorrelation &c : correlations_of(study))
    all.push_back({c.a, c.b, c.value});
  return all;
}

nlohmann::ordered_json spreads_json(const Study &study)
{
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const UncertainKey &key : study.keys)
    all.push_back({{"kind", int(key.spread.kind)},
                   {"mean", json_number(key.spread.mean)},
                   {"sd", json_number(key.spread.sd)},
                   {"low", json_number(key.spread.low)},
                   {"high", json_number(key.spread.high)}});
  return all;
}
}  // namespace

std::vector<std::vector<double>> draw_rows(const Study &study, const StudyMethod method, const long n)
{
  const ScratchFolder scratch("millstand-draw");
  std::filesystem::create_directories(scratch.path());
  const int number = method == StudyMethod::latin_hypercube ? 0
                     : method == StudyMethod::monte_carlo   ? 1
                                                            : 2;  // DrawMethod
  nlohmann::ordered_json request{
      {"task", word_of(StudyTask::draw)}, {"method", number}, {"n", n}, {"seed", study.seed}};
  request["correlations"]  = correlations_json(study);
  request["spreads"]       = spreads_json(study);
  const std::size_t n_rows = answer_of(scratch.path(), request)["rows"].get<std::size_t>(), d = study.keys.size();
  const std::string bytes = read_text(scratch.path() + "/rows.bin");
  std::vector<std::vector<double>> rows(n_rows, std::vector<double>(d));
  for (std::size_t i = 0; i < n_rows; ++i)
    std::memcpy(rows[i].data(), bytes.data() + i * d * sizeof(double), d * sizeof(double));
  return rows;
}

std::vector<IndicesOfResult> indices_of(const std::vector<std::vector<double>> &rows,
                                        const std::vector<std::vector<double>> &results, const long n)
{
  const ScratchFolder scratch("millstand-indices");
  std::filesystem::create_directories(scratch.path());
  write_atomically(scratch.path() + "/rows.bin", bytes_of(rows));
  write_atomically(scratch.path() + "/results.bin", bytes_of(results));
  std::vector<IndicesOfResult> all;
  for (const nlohmann::ordered_json &s : answer_of(
           scratch.path(), {{"task", word_of(StudyTask::indices)}, {"keys", rows.front().size()}, {"n", n}})) {
    IndicesOfResult one;
    one.first      = numbers_of(s["first"]);
    one.total      = numbers_of(s["total"]);
    one.first_low  = numbers_of(s["first_low"]);
    one.first_high = numbers_of(s["first_high"]);
    one.total_low  = numbers_of(s["total_low"]);
    one.total_high = numbers_of(s["total_high"]);
    s["groups"].get_to(one.groups);
    all.push_back(one);
  }
  return all;
}

nlohmann::ordered_json chaos_of(const Study &study, const std::vector<std::vector<double>> &rows,
                                const std::vector<std::vector<double>> &results, const long fitted)
{
  const ScratchFolder scratch("millstand-chaos");
  std::filesystem::create_directories(scratch.path());
  write_atomically(scratch.path() + "/rows.bin", bytes_of(rows));
  write_atomically(scratch.path() + "/results.bin", bytes_of(results));
  return answer_of(scratch.path(), {{"task", word_of(StudyTask::chaos)},
                                    {"keys", study.keys.size()},
                                    {"spreads", spreads_json(study)},
                                    {"fitted", fitted},
                                    {"seed", study.seed}});
}
}  // namespace mill
