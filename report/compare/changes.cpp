#include "core/records/result_names.h"
#include "report/compare/comparison.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace mill::report {
namespace {
constexpr double rounding = 1e-9;

std::string trimmed(const std::string &text)
{
  const auto begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// The value of a line without the comment behind it; a '#' inside quotes belongs to the value.
std::string value_in(const std::string &text)
{
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"')
      quoted = !quoted;
    if (text[i] == '#' && !quoted)
      return trimmed(text.substr(0, i));
  }
  return trimmed(text);
}

using Inputs = std::vector<std::pair<std::string, std::string>>;  // key, value, in the order of the file

// resolved.toml has one key a line; sections in double brackets are counted from 0.
Inputs inputs_in(const std::string &resolved)
{
  Inputs inputs;
  std::istringstream lines(resolved);
  std::string line, section;
  std::map<std::string, int> repeated;
  while (std::getline(lines, line)) {
    line = trimmed(line);
    if (line.rfind("[[", 0) == 0) {
      const std::string name = line.substr(2, line.find("]]") - 2);
      section                = name + "." + std::to_string(repeated[name]++) + ".";
    } else if (!line.empty() && line[0] == '[')
      section = line.substr(1, line.find(']') - 1) + ".";
    else if (const auto equals = line.find(" = "); !line.empty() && line[0] != '#' && equals != std::string::npos)
      inputs.emplace_back(section + line.substr(0, equals), value_in(line.substr(equals + 3)));
  }
  return inputs;
}

std::string value_of(const Inputs &inputs, const std::string &key)
{
  const auto match = std::find_if(inputs.begin(), inputs.end(), [&](const auto &one) { return one.first == key; });
  return match == inputs.end() ? "" : match->second;
}

bool states_error(const Result &result)
{
  return std::isfinite(result.error_estimate);
}

// What a mill is judged by.
bool leads(const Result &result)
{
  const auto parts = parts_of(result.name);
  return is_of(result.name, result_name({family::stand, "modulus"})) ||
         (parts.front() == family::mode && parts.back() == "frequency") ||
         (parts.front() == family::chatter && parts.back() == "critical_speed");
}

// Against the first run that has the result.
ChangedResult change_of(std::vector<const Result *> results)
{
  ChangedResult c{std::move(results)};
  const auto first =
      std::find_if(c.results.begin(), c.results.end(), [](const Result *r) { return r != nullptr; });
  for (auto other = first + 1; other != c.results.end(); ++other) {
    if (!*other)
      continue;
    const double size = std::max(std::abs((*first)->value), std::abs((*other)->value));
    const double change =
        size > 0 ? ((*other)->value - (*first)->value) / ((*first)->value != 0 ? std::abs((*first)->value) : size)
                 : 0;
    if (std::abs(change) > std::abs(c.change)) {
      c.change = change;
      c.known  = states_error(**first) && states_error(**other);
      c.beyond =
          c.known && std::abs(change) > std::abs((*first)->error_estimate) + std::abs((*other)->error_estimate);
    }
  }
  return c;
}
}  // namespace

std::vector<ChangedInput> changed_inputs(const std::vector<std::string> &resolved)
{
  std::vector<Inputs> all;
  std::vector<std::string> keys;
  for (const std::string &text : resolved) {
    all.push_back(inputs_in(text));
    for (const auto &[key, value] : all.back())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        keys.push_back(key);
  }
  std::vector<ChangedInput> changed;
  for (const std::string &key : keys) {
    ChangedInput one{key, {}};
    for (const Inputs &inputs : all)
      one.values.push_back(value_of(inputs, key));
    if (std::any_of(one.values.begin(), one.values.end(), [&](const auto &v) { return v != one.values.front(); }))
      changed.push_back(one);
  }
  return changed;
}

std::vector<ChangedResult> changed_results(const std::vector<Run> &runs)
{
  std::vector<ChangedResult> changed;
  std::vector<std::string> seen;
  for (const Run &run : runs)
    for (const Result &result : run.results) {
      if (std::find(seen.begin(), seen.end(), result.name) != seen.end())
        continue;
      seen.push_back(result.name);
      std::vector<const Result *> all;
      int finite = 0;
      for (const Run &other : runs) {
        const Result *r = other.find(result.name);
        all.push_back(r && std::isfinite(r->value) ? r : nullptr);
        finite += all.back() != nullptr;
      }
      if (finite < 2)
        continue;
      if (const ChangedResult c = change_of(all); std::abs(c.change) > rounding)
        changed.push_back(c);
    }
  std::stable_sort(changed.begin(), changed.end(), [](const ChangedResult &a, const ChangedResult &b) {
    return std::abs(a.change) > std::abs(b.change);
  });
  std::stable_partition(changed.begin(), changed.end(), [](const ChangedResult &c) {
    return leads(**std::find_if(c.results.begin(), c.results.end(), [](const Result *r) { return r != nullptr; }));
  });
  return changed;
}
}  // namespace mill::report
