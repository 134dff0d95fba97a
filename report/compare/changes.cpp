#include "core/case/resolved_sections.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_chatter.h"
#include "core/records/rows_of_stand.h"
#include "report/compare/certainty.h"
#include <algorithm>
#include <cmath>
#include <optional>
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

struct Input {
  std::string key, value;
  bool estimated = false;
};
using Inputs = std::vector<Input>;  // in the order of the file

// "# frame.piston_mass = "1700 kg" is estimated, .."; a name without a dot is one of the section.
std::optional<Input> estimate_in(const std::string &line, const std::string &section)
{
  const auto equals = line.find(" = "), end = line.find(" is estimated");
  if (line.rfind("# ", 0) != 0 || equals == std::string::npos || end == std::string::npos || end < equals)
    return {};
  const std::string name = line.substr(2, equals - 2);
  return Input{name.find('.') == std::string::npos ? section + name : name,
               line.substr(equals + 3, end - equals - 3), true};
}

// resolved.toml has one key a line; sections in double brackets are counted from 0.
Inputs inputs_in(const std::string &resolved)
{
  Inputs inputs;
  std::istringstream lines(resolved);
  std::string line, section;
  ResolvedSections sections;
  while (std::getline(lines, line)) {
    line = trimmed(line);
    if (!line.empty() && line[0] == '[')
      section = sections.prefix(line);
    else if (const auto estimate = estimate_in(line, section))
      inputs.push_back(*estimate);
    else if (const auto equals = line.find(" = "); !line.empty() && line[0] != '#' && equals != std::string::npos)
      inputs.push_back({section + line.substr(0, equals), value_in(line.substr(equals + 3))});
  }
  return inputs;
}

Input input_of(const Inputs &inputs, const std::string &key)
{
  const auto match = std::find_if(inputs.begin(), inputs.end(), [&](const Input &one) { return one.key == key; });
  return match == inputs.end() ? Input{key, ""} : *match;
}

// Equal values, or two estimates: these follow what is given, by the same rule.
bool are_alike(const Input &a, const Input &b)
{
  return a.estimated == b.estimated && (a.estimated || a.value == b.value);
}

std::vector<std::string> keys_of(const std::vector<Inputs> &all)
{
  std::vector<std::string> keys;
  for (const Inputs &inputs : all)
    for (const Input &input : inputs)
      if (std::find(keys.begin(), keys.end(), input.key) == keys.end())
        keys.push_back(input.key);
  return keys;
}

// "K4 = { value = .., error_estimate = 0.05 }" or "barrel_length_tolerance" next to the value.
bool states_own_error(const Inputs &inputs, const Input &input)
{
  return input.value.find("error_estimate = ") != std::string::npos ||
         !input_of(inputs, input.key + "_tolerance").value.empty();
}

std::vector<DifferentInput> different_inputs(const Inputs &first, const Inputs &other)
{
  std::vector<DifferentInput> different;
  for (const std::string &key : keys_of({first, other}))
    if (const Input a = input_of(first, key), b = input_of(other, key); !are_alike(a, b))
      different.push_back({key, a.value, b.value, a.estimated != b.estimated,
                           states_own_error(first, a) || states_own_error(other, b)});
  return different;
}

const ResultRow *const moduli[]{&row::stand::modulus_kiss, &row::stand::modulus_kiss_secant,
                                &row::stand::modulus_tangent, &row::stand::modulus_secant,
                                &row::stand::modulus_by_width};
const ResultRow *const critical_speeds[]{&row::chatter::critical_speed, &row::chatter::scheme_critical_speed,
                                         &row::chatter::variant_critical_speed,
                                         &row::chatter::structure_critical_speed};

// What a mill is judged by.
bool leads(const Result &result)
{
  const auto id = result_id(result.name);
  return id && ((id->is_of(moduli) && id->place("pass").empty()) ||
                (id->is_of(row::modes::frequency) && id->place("open").empty()) || id->is_of(critical_speeds));
}

double change_between(const Result &first, const Result &other)
{
  const double size = std::max(std::abs(first.value), std::abs(other.value));
  return size > 0 ? (other.value - first.value) / (first.value != 0 ? std::abs(first.value) : size) : 0;
}

// Against the first run that has the result.
ChangedResult change_of(const std::vector<Run> &runs, const std::vector<Inputs> &inputs,
                        std::vector<const Result *> results)
{
  ChangedResult c{std::move(results)};
  std::size_t first = 0, largest = 0;
  while (c.results[first] == nullptr)
    ++first;
  largest = first;
  for (std::size_t other = first + 1; other < c.results.size(); ++other)
    if (c.results[other])
      if (const double change = change_between(*c.results[first], *c.results[other]);
          std::abs(change) > std::abs(c.change)) {
        c.change = change;
        largest  = other;
      }
  if (std::abs(c.change) > rounding) {
    DifferenceError error = error_of_difference(runs[first], runs[largest], *c.results[first], *c.results[largest],
                                                c.change, different_inputs(inputs[first], inputs[largest]));
    c.certainty           = error.certainty;
    c.error               = error.error;
    c.behind              = std::move(error.behind);
  }
  return c;
}

std::vector<Inputs> inputs_of_all(const std::vector<std::string> &resolved)
{
  std::vector<Inputs> all;
  for (const std::string &text : resolved)
    all.push_back(inputs_in(text));
  return all;
}
}  // namespace

std::vector<ChangedInput> changed_inputs(const std::vector<std::string> &resolved)
{
  const std::vector<Inputs> all = inputs_of_all(resolved);
  std::vector<ChangedInput> changed;
  for (const std::string &key : keys_of(all)) {
    std::vector<Input> values;
    for (const Inputs &inputs : all)
      values.push_back(input_of(inputs, key));
    if (std::all_of(values.begin(), values.end(), [&](const Input &v) { return are_alike(v, values.front()); }))
      continue;
    changed.push_back({key, {}});
    for (const Input &value : values)
      changed.back().values.push_back(value.value + (value.estimated ? " (estimated)" : ""));
  }
  return changed;
}

std::vector<ChangedResult> changed_results(const std::vector<Run> &runs, const std::vector<std::string> &resolved)
{
  const std::vector<Inputs> inputs = inputs_of_all(resolved);
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
      if (const ChangedResult c = change_of(runs, inputs, all); std::abs(c.change) > rounding)
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
