#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// Tolerances of given values: one row for each quantity, made from the quantity's own row.
namespace mill {
namespace {
const std::string suffix = "_tolerance";
}

bool is_tolerance(const std::string &key)
{
  return key.size() > suffix.size() && key.compare(key.size() - suffix.size(), suffix.size(), suffix) == 0;
}

std::string tolerance_key(const std::string &key)
{
  return key + suffix;
}

std::vector<Row> tolerance_rows(const std::vector<Row> &rows)
{
  std::vector<Row> all;
  for (const Row &row : rows)
    if (row.kind == Kind::quantity)
      all.push_back({tolerance_key(row.key),
                     Kind::quantity,
                     "%",
                     {0, 100},
                     absent,
                     "5 %",
                     fmt::format("how far {} may be off, of its value", row.key)});
  return all;
}

std::map<std::string, double> read_tolerances(const std::vector<Row> &rows, const Section &section,
                                              Reading &reading)
{
  std::map<std::string, double> tolerance;
  for (const Row &row : tolerance_rows(rows))
    if (const auto value = read_row(row, section, reading)) {
      const std::string key = row.key.substr(0, row.key.size() - suffix.size());
      tolerance[key]        = std::get<double>(*value);
      reading.echo += row.key + " = " + toml_of(row, *value) + "\n";
    }
  return tolerance;
}
}  // namespace mill
