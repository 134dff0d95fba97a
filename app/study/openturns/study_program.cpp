#include "app/study/openturns/chaos.h"
#include "app/study/openturns/drawn_design.h"
#include "app/study/study_task.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/model/material.h"
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <nlohmann/json.hpp>

// millstand-study FOLDER: carries out FOLDER/request.json with OpenTURNS and writes FOLDER/answer.json.  millstand
// starts it (app/study/analysis_program.h); users do not type it.  It links no finite elements.
namespace {
using nlohmann::json;
using namespace mill;

std::vector<double> numbers_of_file(const std::string &path)
{
  const std::string bytes = read_text(path);
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

void write_numbers(const std::string &path, const std::vector<double> &numbers)
{
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  write_atomically(path, bytes);
}

double number_or_nan(const json &value)
{
  return value.is_number() ? value.get<double>() : not_given;
}

std::vector<Spread> spreads_of(const json &request)
{
  std::vector<Spread> spreads;
  for (const json &s : request["spreads"])
    spreads.push_back({Spread::Kind(s["kind"].get<int>()), number_or_nan(s["mean"]), number_or_nan(s["sd"]),
                       number_or_nan(s["low"]), number_or_nan(s["high"])});
  return spreads;
}

json drawn(const json &request, const std::string &folder)
{
  std::vector<Correlation> correlations;
  for (const json &c : request["correlations"])
    correlations.push_back({c[0].get<std::size_t>(), c[1].get<std::size_t>(), c[2].get<double>()});
  const auto rows = drawn_rows(DrawMethod(request["method"].get<int>()), spreads_of(request), correlations,
                               request["n"].get<long>(), request["seed"].get<int>());
  std::vector<double> numbers;
  for (const auto &row : rows)
    numbers.insert(numbers.end(), row.begin(), row.end());
  write_numbers(folder + "/rows.bin", numbers);
  return {{"rows", rows.size()}};
}

// Rows and results that the request has left in its folder.
struct ComputedRows {
  std::vector<std::vector<double>> rows, results;  // (rows, keys), (results)(rows)
};

ComputedRows computed_rows(const json &request, const std::string &folder)
{
  const auto numbers = numbers_of_file(folder + "/rows.bin"), values = numbers_of_file(folder + "/results.bin");
  const auto d = request["keys"].get<std::size_t>();
  ComputedRows all;
  for (auto row = numbers.begin(); row != numbers.end(); row += std::ptrdiff_t(d))
    all.rows.emplace_back(row, row + std::ptrdiff_t(d));
  for (auto one = values.begin(); one != values.end(); one += std::ptrdiff_t(all.rows.size()))
    all.results.emplace_back(one, one + std::ptrdiff_t(all.rows.size()));
  return all;
}

json indices(const json &request, const std::string &folder)
{
  const ComputedRows computed = computed_rows(request, folder);
  json answer                 = json::array();
  for (const auto &result : computed.results) {
    const SobolIndices s = sobol_indices(computed.rows, result, request["n"].get<long>());
    answer.push_back({{"first", s.first},
                      {"total", s.total},
                      {"first_low", s.first_low},
                      {"first_high", s.first_high},
                      {"total_low", s.total_low},
                      {"total_high", s.total_high},
                      {"groups", s.groups}});
  }
  return answer;
}

json chaos(const json &request, const std::string &folder)
{
  const ComputedRows computed = computed_rows(request, folder);
  const auto spreads          = spreads_of(request);
  json answer                 = json::array();
  for (const auto &result : computed.results) {
    const ChaosFit f =
        chaos_fit(spreads, computed.rows, result, request["fitted"].get<long>(), request["seed"].get<int>());
    if (f.terms == 0) {
      answer.push_back(nullptr);
      continue;
    }
    answer.push_back(
        {{"degree", f.degree},
         {"terms", f.terms},
         {"rows", f.rows},
         {"held_out_rows", f.held_out_rows},
         {"mean", f.mean},
         {"sd", f.sd},
         {"leave_one_out", f.leave_one_out},
         {"held_out", f.held_out},
         {"first", f.first},
         {"total", f.total},
         {"first_low", f.first_low},
         {"first_high", f.first_high},
         {"total_low", f.total_low},
         {"total_high", f.total_high},
         {"computed", f.computed},
         {"predicted", f.predicted},
         {"map", {{"x_key", f.map_x}, {"y_key", f.map_y}, {"x", f.x}, {"y", f.y}, {"height", f.height}}}});
  }
  return answer;
}

json answer_to(const json &request, const std::string &folder)
{
  switch (choice_named<StudyTask>(request["task"].get<std::string>()).value()) {
  case StudyTask::draw:
    return drawn(request, folder);
  case StudyTask::indices:
    break;
  case StudyTask::chaos:
    return chaos(request, folder);
  }
  return indices(request, folder);
}

void carry_out(const std::string &folder)
{
  json answer;
  try {
    const json request = json::parse(read_text(folder + "/request.json"));
    answer["answer"]   = answer_to(request, folder);
  } catch (const InputError &e) {
    answer["refused"] = e.problems.empty() ? e.what() : e.problems.front().message;
  }
  write_atomically(folder + "/answer.json", answer.dump());
}
}  // namespace

int main(int argc, char **argv)
{
  // Matrices are small: threads would wait for each other, on a busy machine a hundred times longer than they
  // work.
  if (const auto set_threads = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set_threads(1);
  if (argc != 2) {
    std::fputs("millstand-study is started by millstand; type: millstand study\n", stderr);
    return 2;
  }
  try {
    carry_out(argv[1]);
    return 0;
  } catch (const std::exception &e) {
    std::fprintf(stderr, "millstand-study: %s\n", e.what());
    return 1;
  }
}
