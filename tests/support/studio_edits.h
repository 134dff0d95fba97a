#pragma once
#include "tests/support/program.h"
#include "tests/support/studio_program.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <regex>
#include <tuple>

// Edits of a stand by the page, each held against `millstand check` of the saved file.
inline std::string new_stand(const std::string &name, const std::string &kind = "four-high")
{
  const std::string folder = scratch("studio-" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  EXPECT_EQ(millstand("new " + kind + " -o " + folder + "/stand.toml").exit_code, 0);
  return folder;
}

struct Line {
  int line, column;
  std::string severity, message;
  bool operator<(const Line &other) const
  {
    return std::tie(line, column, message) < std::tie(other.line, other.column, other.message);
  }
  bool operator==(const Line &other) const
  {
    return std::tie(line, column, severity, message) ==
           std::tie(other.line, other.column, other.severity, other.message);
  }
};
inline std::ostream &operator<<(std::ostream &out, const Line &l)
{
  return out << l.line << ":" << l.column << " " << l.severity << " " << l.message;
}

// "stand.toml:11:19: error: ..": what the command line prints of a case.
inline std::vector<Line> of_command_line(const std::string &text)
{
  static const std::regex form("(?:^|\n)[^\n]*?stand\\.toml(?::(\\d+):(\\d+))?: (error|warning): ([^\n]*)");
  std::vector<Line> lines;
  for (std::sregex_iterator it(text.begin(), text.end(), form), end; it != end; ++it)
    lines.push_back({std::atoi((*it)[1].str().c_str()), std::atoi((*it)[2].str().c_str()), (*it)[3], (*it)[4]});
  std::sort(lines.begin(), lines.end());
  return lines;
}

inline std::vector<Line> of_page(const nlohmann::json &answer)
{
  std::vector<Line> lines;
  for (const nlohmann::json &p : answer["problems"])
    lines.push_back({p["line"], p["column"], p["severity"], p["message"]});
  std::sort(lines.begin(), lines.end());
  return lines;
}

// An edit that a user might make, right or wrong.
inline std::pair<std::string, std::string> random_edit(const nlohmann::json &values, std::mt19937 &draw)
{
  std::vector<std::string> keys;
  for (const auto &[key, value] : values.items())
    if (key != "schema" && key != "kind")
      keys.push_back(key);
  const std::string key   = keys[draw() % keys.size()];
  const std::string value = values[key].get<std::string>();
  double number           = 0;
  const bool is_number    = std::sscanf(value.c_str(), "%lf", &number) == 1;
  const std::string unit =
      is_number ? value.substr(std::min(value.find_first_not_of("0123456789.-+"), value.size())) : "";
  const char *const units[] = {" mm", " in", " bar", " MN", " t", "", " deg"};
  switch (draw() % 6) {
  case 0:
    return {key, "12,5" + unit};
  case 1:
    return {key, fmt::format("{:g}{}", number, units[draw() % std::size(units)])};
  case 2:
    return {key, "x" + value};
  default:
    return {key, is_number ? fmt::format("{:.6g}{}", number * (0.9 + 0.02 * double(draw() % 10)), unit) : value};
  }
}

/// Random edits, right and wrong ones, every third taken back.
/// @return  those whose problems, places or exit code are not those of the command line, and how many were wrong
struct JudgedEdits {
  std::vector<std::string> differ;
  int wrong = 0;
};
inline JudgedEdits judge_random_edits(const std::string &folder, const int edits, const unsigned seed)
{
  StudioProgram studio(folder);
  JudgedEdits judged;
  std::mt19937 draw(seed);
  nlohmann::json values = studio.get("/document")["values"];
  for (int i = 0; i < edits; ++i) {
    const auto [key, value]     = random_edit(values, draw);
    const nlohmann::json answer = studio.edit(std::to_string(i), key, value);
    const bool saved            = studio.post("/save", nlohmann::json::object()).contains("revision");
    if (!answer.contains("problems") || !saved) {
      judged.differ.push_back(key + " = " + value + ": " + answer.dump());
      break;
    }
    values              = answer["values"];
    const Outcome check = millstand("check " + folder + "/stand.toml");
    const bool errors   = std::any_of(answer["problems"].begin(), answer["problems"].end(),
                                      [](const nlohmann::json &p) { return p["severity"] == "error"; });
    if (!(of_page(answer) == of_command_line(check.out + check.err)) || (check.exit_code == 2) != errors)
      judged.differ.push_back(key + " = " + value + ": " + answer["problems"].dump() + " against " + check.out +
                              check.err);
    judged.wrong += errors;
    if (errors || i % 3 == 2)
      values = studio.post("/edit", {{"op", "undo"}})["values"];
  }
  return judged;
}
