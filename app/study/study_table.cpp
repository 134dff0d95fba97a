#include "app/study/study_table.h"
#include "app/process/version.h"
#include "app/study/json_number.h"
#include "core/base/si_unit.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/records/csv.h"
#include "core/records/csv_cell.h"
#include "report/results/names.h"
#include <cmath>

namespace mill {
namespace {
std::string number_cell(const double value)
{
  return std::isfinite(value) ? number_text(value) : "";
}

}  // namespace

std::string column_head(const std::string &name, const std::string &unit)
{
  const std::string text = name + after_name(unit);
  return has_any(text, ";") ? quoted_cell(text) : csv_cell(text);
}

std::string table_csv(const StudyTable &table)
{
  std::string text = "row";
  for (const VariedKey &key : table.keys)
    text += "," + column_head(key.name, key.unit);
  for (const auto &[name, result] : table.watched)
    text += "," + column_head(name, result.unit);
  text += ",failure\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const TableRow &row = table.rows[i];
    text += std::to_string(i + 1);
    for (std::size_t k = 0; k < row.values.size(); ++k)
      text += "," + (std::isfinite(row.numbers[k]) ? number_text(row.numbers[k]) : quoted_cell(row.values[k]));
    for (const double result : row.results)
      text += "," + number_cell(result);
    text += "," + (row.failure.empty() ? "" : quoted_cell(row.failure)) + "\n";
  }
  return text;
}

std::string table_json(const StudyTable &table)
{
  nlohmann::ordered_json json{
      {"schema", 1},          {"case", table.case_name}, {"case_path", table.case_path}, {"title", table.title},
      {"version", version()}, {"work", table.work},      {"seconds", table.seconds}};
  for (const VariedKey &key : table.keys)
    json["keys"].push_back({{"name", key.name}, {"unit", key.unit}, {"meaning", key.meaning}});
  for (const auto &[name, result] : table.watched)
    json["results"].push_back({{"name", name},
                               {"unit", result.unit},
                               {"meaning", report::meaning_of(name)},
                               {"base", json_number(result.value)},
                               {"error_estimate", json_number(result.error_estimate)}});
  json["rows"] = nlohmann::ordered_json::array();
  for (const TableRow &row : table.rows) {
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array(), results = numbers;
    for (const double number : row.numbers)
      numbers.push_back(json_number(number));
    for (const double result : row.results)
      results.push_back(json_number(result));
    json["rows"].push_back(
        {{"values", row.values}, {"numbers", numbers}, {"results", results}, {"failure", row.failure}});
  }
  return json.dump(1) + "\n";
}
}  // namespace mill
