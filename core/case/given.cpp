#include "core/case/given.h"
#include "core/base/source_text.h"
#include "core/base/units.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
// Ends of the interval of a calibrated value, as its checks.
constexpr const char *interval_from = "95 % from", *interval_to = "95 % to";
// A value from records of the mill: measured; the text after the colon says how.
constexpr const char *calibrated = "calibrated";

// Keys of { value = "...", source = "...", ... }.
struct GivenInput {
  std::string source, at, method;
  double error_estimate = not_given;  // -, relative
};
const std::vector<Field<GivenInput>> &table_rows()
{
  using T = GivenInput;
  static const std::vector<Field<T>> rows{
      {"source", &T::source, "text", {}, "given", "published", "given, published, measured, assumed or computed"},
      {"method", &T::method, "text", {}, absent, "contact FEM", "how it was computed or assumed"},
      {"at", &T::at, "text", {}, absent, "976.2 kN", "load or state it belongs to"},
      {"error_estimate", &T::error_estimate, "1", {0, 10}, absent, "0.01", "relative"},
  };
  return rows;
}

std::vector<std::string> read_inputs(const Section &section, Reading &reading)
{
  std::vector<std::string> inputs;
  const Node::Entry *entry = section.node->find("inputs");
  if (!entry)
    return inputs;
  const auto &items = entry->value.items;
  const bool is_list =
      entry->value.kind == Node::Kind::array &&
      std::all_of(items.begin(), items.end(), [](const Node &i) { return i.kind == Node::Kind::text; });
  if (!is_list)
    reading.add(entry->value.place,
                fmt::format("{} = {} is not a list of keys, for example [\"work_roll.barrel_diameter\"]",
                            section.key("inputs"), shown(entry->value)));
  else
    for (const Node &item : items)
      inputs.push_back(item.text);
  return inputs;
}

Parameter read_table(const Row &row, const Section &section, Reading &reading)
{
  Parameter parameter;
  GivenInput input;
  read(section, table_rows(), input, reading, {"value", "inputs", "interval"});
  Row value_row      = row;
  value_row.key      = "value";
  value_row.fallback = required;
  if (const auto value = read_row(value_row, section, reading))
    parameter.value = std::get<double>(*value);
  Row interval{"interval", Kind::pair, row.form, row.range, absent, "", "95 %, from and to", ""};
  if (const auto ends = read_row(interval, section, reading)) {
    const auto &[from, to] = std::get<std::array<double, 2>>(*ends);
    parameter.checks       = {{interval_from, from, ""}, {interval_to, to, ""}};
  }
  if (!parse_source(input.source, parameter))
    reading.add(
        reading.place(section.key("source")),
        fmt::format("{} is unknown; given, published, measured, \"assumed: why\" or \"computed: how\" is needed",
                    reading.as_written(section.key("source"))));
  if (!input.method.empty())
    parameter.method = input.method;
  parameter.at             = operating_point_of(input.at);
  parameter.error_estimate = input.error_estimate;
  parameter.inputs         = read_inputs(section, reading);
  return parameter;
}

// Value with its place; nothing when absent or refused.
std::optional<GivenValue> read_one(const Row &row, const Section &given, Reading &reading)
{
  const Node::Entry *entry = given.node ? given.node->find(row.key) : nullptr;
  if (!entry)
    return std::nullopt;
  GivenValue result;
  result.place          = entry->value.place;
  const std::string key = given.key(row.key);
  const auto n_problems = reading.problems.size();
  if (entry->value.kind == Node::Kind::table) {
    result.parameter = read_table(row, {&entry->value, key}, reading);
  } else if (const auto value = read_row(row, given, reading)) {
    result.parameter.value  = std::get<double>(*value);
    result.parameter.source = Source::given;
  }
  if (reading.problems.size() > n_problems) {
    reading.bad.insert(key);
    return std::nullopt;
  }
  result.parameter.unit = row.form == "kN/mm" || row.form == "N/mm" ? "N/m" : row.form;
  reading.places[key]   = result.place;
  return result;
}

// K1_tolerance of K1; a value that has its own error estimate accepts no second one.
std::map<std::string, double> given_tolerances(const std::vector<Row> &rows, const Section &given,
                                               Reading &reading)
{
  std::string echo;
  std::swap(echo, reading.echo);  // resolved.toml says it as the error estimate of the value
  const auto tolerance = read_tolerances(rows, given, reading);
  std::swap(echo, reading.echo);
  for (const auto &entry : tolerance) {
    const std::string &key    = entry.first;
    const std::string own_key = given.key(tolerance_key(key));
    if (!given.node->find(key))
      reading.add(reading.place(own_key), fmt::format("{} belongs to {}, which is not given; give both or neither",
                                                      reading.as_written(own_key), given.key(key)));
  }
  return tolerance;
}

// One sentence for all that a lumped case lacks.
void report_missing(const Section &given, const std::vector<Row> &rows, Reading &reading)
{
  std::string missing;
  const Row *first = nullptr;
  for (const Row &row : rows)
    if (row.fallback.kind == Fallback::Kind::required && !(given.node && given.node->find(row.key))) {
      missing += (missing.empty() ? "" : ", ") + row.key;
      first = first ? first : &row;
    }
  if (!first)
    return;
  const std::string where = given.node ? "[given] lacks " : "the section [given] is missing; it needs ";
  reading.add(given.node ? given.node->place : Place{reading.file},
              fmt::format("{}{}; add for example {} = {}", where, missing, first->key, example_toml(*first)));
}
}  // namespace

std::vector<std::string> given_table_keys()
{
  std::vector<std::string> keys{"value", "inputs", "interval"};
  for (const Row &row : rows_of(table_rows()))
    keys.push_back(row.key);
  return keys;
}

bool parse_source(const std::string &text, Parameter &parameter)
{
  if (text.substr(0, text.find(": ")) == calibrated) {
    parameter.source = Source::measured;
    parameter.method = text;
    return true;
  }
  auto [source, method] = source_in(text);
  if (source) {
    parameter.source = *source;
    parameter.method = std::move(method);
  }
  return source.has_value();
}

std::string given_toml(const Row &row, const Parameter &parameter)
{
  const std::string value = toml_of(row, parameter.value);
  const bool plain = parameter.source == Source::given && parameter.method.empty() && parameter.at.empty() &&
                     parameter.inputs.empty() && std::isnan(parameter.error_estimate);
  if (plain)
    return value;
  const bool from_records = parameter.source == Source::measured && parameter.method.rfind(calibrated, 0) == 0;
  std::string text        = fmt::format("{{ value = {}, source = {}", value,
                                        quoted(from_records ? parameter.method : source_text(parameter)));
  const auto end          = [&](const char *name) {
    return std::find_if(parameter.checks.begin(), parameter.checks.end(),
                                 [&](const Check &check) { return check.name == name; });
  };
  if (const auto from = end(interval_from), to = end(interval_to);
      from != parameter.checks.end() && to != parameter.checks.end())
    text += ", interval = [" + toml_of(row, from->value) + ", " + toml_of(row, to->value) + "]";
  if (!parameter.at.empty())
    text += ", at = " + quoted(parameter.at.text());
  if (!std::isnan(parameter.error_estimate))
    text += ", error_estimate = " + number_text(parameter.error_estimate);
  if (!parameter.inputs.empty()) {
    std::string list;
    for (const std::string &input : parameter.inputs)
      list += (list.empty() ? "" : ", ") + quoted(input);
    text += ", inputs = [" + list + "]";
  }
  return text + " }";
}

GivenValues read_given(const Node &root, const std::string &name, const std::string &kind, Reading &reading)
{
  GivenValues values;
  const Section given = section_at(root, name, reading);
  const auto &rows    = given_rows(kind, name == "published");
  report_missing(given, rows, reading);
  const bool replaces = name == "given";  // a value that is only compared with a result needs no error of its own
  std::vector<std::string> others;
  if (replaces)
    for (const Row &row : tolerance_rows(rows))
      others.push_back(row.key);
  refuse_unknown_keys(given, rows, others, reading);
  const auto tolerance = replaces ? given_tolerances(rows, given, reading) : std::map<std::string, double>();
  reading.echo += "\n[" + name + "]\n";
  for (const Row &row : rows)
    if (auto value = read_one(row, given, reading)) {
      if (const auto entry = tolerance.find(row.key); entry != tolerance.end()) {
        const std::string error = given.key(row.key) + ".error_estimate";
        if (!std::isnan(value->parameter.error_estimate))
          contradict(reading, given.key(tolerance_key(row.key)),
                     "repeats or contradicts the error estimate of the value; leave one of the two out", {error});
        value->parameter.error_estimate = entry->second;
      }
      if (replaces && std::isnan(value->parameter.error_estimate))
        value->parameter.error_lacks = {given.key(tolerance_key(row.key))};
      values[row.key] = *value;
      reading.echo += row.key + " = " + given_toml(row, value->parameter) + "\n";
    }
  return values;
}
}  // namespace mill
