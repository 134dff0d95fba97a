#include "app/studio/answers/check_answer.h"
#include "app/run/run_kind.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include "core/case/case_edit.h"
#include "core/model/four_high.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace mill::studio {
namespace {
using nlohmann::ordered_json;

bool stands_in(const std::string &message, const std::string &word)
{
  const auto is_part = [](const char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  for (auto place = message.find(word); place != std::string::npos; place = message.find(word, place + 1)) {
    const auto end = place + word.size();
    if ((place == 0 || !is_part(message[place - 1])) && (end == message.size() || !is_part(message[end])))
      return true;
  }
  return false;
}

std::string key_at(const Place &place, const std::vector<WrittenValue> &values)
{
  for (const WrittenValue &value : values)
    if (place.line > 0 && value.line == place.line)
      return value.key;
  return "";
}

// The key that a problem is about: the one whose line it names, else the only one that it names in words.
std::string key_of(const Problem &problem, const std::vector<WrittenValue> &values)
{
  if (const std::string key = key_at(problem.place, values); !key.empty())
    return key;
  std::vector<std::string> named;
  for (const WrittenValue &value : values)
    if (stands_in(problem.message, value.key))
      named.push_back(value.key);
  return named.size() == 1 ? named.front() : "";
}

ordered_json problem_json(const Problem &problem, const std::string &key, const char *severity,
                          const std::vector<WrittenValue> &values)
{
  ordered_json out{{"severity", severity},
                   {"line", problem.place.line},
                   {"column", problem.place.column},
                   {"message", visible(problem.message, true)},
                   {"key", key}};
  for (const Place &place : problem.related)
    if (const std::string other = key_at(place, values); !other.empty())
      out["related"].push_back(other);
  return out;
}

ordered_json estimate_json(const Estimate &e)
{
  const Unit &unit = mill::unit(e.unit);
  return {{"key", e.key},
          {"value", from_si(e.value, unit)},
          {"low", from_si(e.low, unit)},
          {"high", from_si(e.high, unit)},
          {"unit", e.unit},
          {"rule", e.rule}};
}
}  // namespace

CheckAnswer check_answer(const std::string &path, const std::string &text)
{
  CheckAnswer answer;
  try {
    answer.checked = checked_text(path, text);
    answer.remarks = remarks_of(*answer.checked);
    answer.facts   = facts_of(*answer.checked);
  } catch (const InputError &error) {
    answer.errors = error.problems;
  }
  return answer;
}

ordered_json check_json(const CheckAnswer &answer, const std::string &text)
{
  const auto values = written_values(text);
  ordered_json out{
      {"problems", ordered_json::array()}, {"facts", ordered_json::array()}, {"values", ordered_json::object()}};
  for (const std::string &fact : answer.facts)
    out["facts"].push_back(visible(fact, true));
  for (const Problem &problem : answer.errors)
    out["problems"].push_back(problem_json(problem, key_of(problem, values), "error", values));
  for (const Warning &remark : answer.remarks)
    out["problems"].push_back(problem_json(
        problem_of(remark), remark.key.empty() ? key_at(remark.place, values) : remark.key, "warning", values));
  for (const WrittenValue &value : values)
    out["values"][value.key] = value.text;
  if (!answer.checked)
    return out;
  const Case &the_case    = answer.checked->the_case;
  out["title"]            = the_case.title;
  out["left_at_template"] = the_case.left_at_template;
  out["estimates"]        = ordered_json::array();
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    for (const Estimate &estimate : stand->estimates)
      out["estimates"].push_back(estimate_json(estimate));
  if (const auto describe = run_kind(the_case).describe) {
    ordered_json manifest;
    describe(the_case, manifest);
    if (manifest.contains("geometry"))
      out["geometry"] = manifest["geometry"];
  }
  return out;
}
}  // namespace mill::studio
