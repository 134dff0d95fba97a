#include "core/records/results.h"
#include "core/base/units.h"
#include "core/records/json_archive.h"
#include "core/records/note_records.h"
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mill {
namespace {
using nlohmann::ordered_json;

ordered_json json_of(const Parameter &parameter)
{
  ordered_json json{{"value", parameter.value},
                    {"unit", parameter.unit},
                    {"source", source_text(parameter)},
                    {"at", parameter.at.text()}};
  for (const OperatingPoint::Value &number : parameter.at.values())  // the numbers of that text
    json["at_values"].push_back({{"value", number.value}, {"unit", number.unit}});
  json["error_estimate"] = parameter.error_estimate;  // NaN, none can be stated, becomes null
  if (!parameter.error_lacks.empty())
    json["error_lacks"] = parameter.error_lacks;  // why there is none
  json["inputs"] = parameter.inputs;
  if (!parameter.estimated.empty())
    json["estimated"] = parameter.estimated;
  if (!parameter.checks.empty()) {
    json["checks"] = ordered_json::array();
    for (const Check &check : parameter.checks)
      json["checks"].push_back({{"name", check.name}, {"value", check.value}, {"note", check.note}});
  }
  return json;
}

ordered_json json_of(const EstimateRecord &record)
{
  const Estimate &e = record.estimate;
  ordered_json json{{"key", e.key},
                    {"value", e.value},
                    {"low", e.low},
                    {"high", e.high},
                    {"unit", si_unit(unit(e.unit)).symbol},
                    {"rule", e.rule}};
  json["moves"] = ordered_json::object();
  for (const auto &[name, move] : record.moves)
    json["moves"][name] = move;
  return json;
}
}  // namespace

void Results::add(const ResultName &name, Parameter parameter)
{
  if (parameter.unit.empty())
    parameter.unit = name.row().unit;
  append({{name.text(), std::move(parameter)}});
}

void Results::append(std::vector<std::pair<std::string, Parameter>> more)
{
  for (auto &[name, parameter] : more) {
    if (find(name))
      throw std::logic_error("the result " + name + " is made twice");
    values.emplace_back(name, std::move(parameter));
  }
}

const Parameter *Results::find(const std::string &name) const
{
  for (const auto &[known, parameter] : values)
    if (known == name)
      return &parameter;
  return nullptr;
}

std::string results_json(const Results &results, const std::string &case_name, const std::string &status,
                         const std::string &run_id)
{
  ordered_json json{{"schema", 1}, {"case", case_name}, {"status", status}};
  if (!run_id.empty())
    json["run_id"] = run_id;
  json["values"] = ordered_json::object();
  for (const auto &[name, parameter] : results.values)
    json["values"][name] = json_of(parameter);
  json["warnings"] = texts_of(results.warnings);  // for readers that want no parts
  std::vector<Warning> records;
  for (const Warning &warning : results.warnings)
    records.push_back(with_file_names(warning));
  json::Writer(json["warning_records"]).write(records);
  json["assumptions"] = results.assumptions;
  if (!results.estimates.empty()) {
    json["estimates"] = ordered_json::array();
    for (const EstimateRecord &record : results.estimates)
      json["estimates"].push_back(json_of(record));
  }
  if (!results.left_at_template.empty())
    json["left_at_template"] = results.left_at_template;
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}
}  // namespace mill
