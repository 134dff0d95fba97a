#include "app/study/openturns/drawn_design.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/model/material.h"
#include <cstdio>
#include <cstring>
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

json indices(const json &request, const std::string &folder)
{
  const auto numbers  = numbers_of_file(folder + "/rows.bin");
  const auto d        = request["keys"].get<std::size_t>();
  const auto results  = numbers_of_file(folder + "/results.bin");
  const std::size_t n = numbers.size() / d;
  std::vector<std::vector<double>> rows(n);
  for (std::size_t i = 0; i < n; ++i)
    rows[i].assign(numbers.begin() + std::ptrdiff_t(i * d), numbers.begin() + std::ptrdiff_t((i + 1) * d));
  json answer = json::array();
  for (std::size_t r = 0; r * n < results.size(); ++r) {
    const std::vector<double> one(results.begin() + std::ptrdiff_t(r * n),
                                  results.begin() + std::ptrdiff_t((r + 1) * n));
    const SobolIndices s = sobol_indices(rows, one, request["n"].get<long>());
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

void carry_out(const std::string &folder)
{
  json answer;
  try {
    const json request = json::parse(read_text(folder + "/request.json"));
    answer["answer"]   = request["task"] == "draw" ? drawn(request, folder) : indices(request, folder);
  } catch (const InputError &e) {
    answer["refused"] = e.problems.empty() ? e.what() : e.problems.front().message;
  }
  write_atomically(folder + "/answer.json", answer.dump());
}
}  // namespace

int main(int argc, char **argv)
{
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
