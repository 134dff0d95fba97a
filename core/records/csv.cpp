#include "core/records/csv.h"
#include "core/base/csv_sheet.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/hidden_characters.h"
#include "core/base/text.h"
#include "core/records/csv_cell.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using csv::Cell;
using csv::Sheet;

Sheet sheet_of(const std::string &path)
{
  return csv::sheet_of(path, read_text(path), "time [s], force [kN]");
}

// A text from outside without characters that a terminal or an editor would obey; line ends and tabs are layout.
std::string without_commands(const std::string &text)
{
  return escaped(text, [](const char32_t code) {
    return code == '\n' || code == '\r' || code == '\t' ? std::string(1, char(code)) : number_of_character(code);
  });
}

// "name [unit]" as a cell of one line, in quotes where RFC 4180 wants them or where the reader would take it for
// something else. A name that ends like a unit gets an empty one.
std::string header_text(std::string name, const std::string &unit)
{
  for (char &c : name)
    if (c == '\n' || c == '\r')
      c = ' ';
  const bool like_a_unit = unit.empty() && !name.empty() && name.back() == ']';
  const std::string cell = without_commands(name + (like_a_unit ? " []" : unit.empty() ? "" : " [" + unit + "]"));
  const bool plain       = !has_any(cell, ",;\t\"") && cell.rfind('#', 0) != 0;
  if (plain)
    return cell;
  std::string quoted = "\"";
  for (const char c : cell)
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

// As number_text, without a string of its own: a response of 100 s has tens of millions of numbers.
void add_number(std::string &text, const double value)
{
  if (!std::isfinite(value))
    return;  // an empty cell
  char digits[64];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace

Table &Table::add(std::string name, std::string unit, Eigen::VectorXd values)
{
  names.push_back(std::move(name));
  units.push_back(std::move(unit));
  columns.push_back(std::move(values));
  return *this;
}

const Eigen::VectorXd *Table::column(const std::string &name) const
{
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name)
      return &columns[i];
  return nullptr;
}

std::string csv_text(const Table &table)
{
  std::string text;
  for (std::size_t c = 0; c < table.names.size(); ++c)
    text += (c ? "," : "") + header_text(table.names[c], table.units[c]);
  text += '\n';
  const Eigen::Index n_rows = table.columns.empty() ? 0 : table.columns.front().size();
  text.reserve(text.size() + std::size_t(n_rows) * (1 + 22 * table.columns.size()));  // of most numbers
  for (Eigen::Index r = 0; r < n_rows; ++r) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c)
        text += ',';
      add_number(text, table.columns[c][r]);
    }
    if (table.columns.size() == 1 && !std::isfinite(table.columns[0][r]))
      text += "\"\"";  // a line of its own, not a blank one that readers skip
    text += '\n';
  }
  return text;
}

bool reads_back(const Table &table)
{
  const auto plain = [](const std::string &text) {
    return text == csv::without_blanks(text) && !has_any(text, "\n\r\"[]") && text == without_commands(text);
  };
  if (table.columns.empty() || table.columns.front().size() == 0)
    return false;  // a file without rows has its own rules
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.names[c].empty() || !plain(table.names[c]) || !plain(table.units[c]))
      return false;
    for (const double value : table.columns[c])
      if (std::abs(value) > csv::largest_in_cell)  // not true of NaN, which is read as such
        return false;
  }
  return true;
}

Table read_table(const std::string &path)
{
  Sheet sheet = sheet_of(path);
  Table table;
  for (std::size_t c = 0; c < sheet.header.size(); ++c) {
    table.names.push_back(sheet.header[c].name);
    table.units.push_back(sheet.header[c].unit);
    Eigen::VectorXd values(Eigen::Index(sheet.n_rows()));
    for (std::size_t r = 0; r < sheet.n_rows(); ++r) {
      const Cell &cell        = sheet.cell(r, c);
      values[Eigen::Index(r)] = cell.text.empty() || cell.text == "nan"
                                    ? std::numeric_limits<double>::quiet_NaN()
                                    : number_of(cell, sheet.header[c].name, sheet);
    }
    table.columns.push_back(std::move(values));
  }
  return table;
}

std::string quoted_cell(const std::string &text)
{
  std::string quoted = "\"";
  for (const char c : without_commands(text))
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_cell(const std::string &text)
{
  return has_any(text, ",\"") || has_hidden(text) ? quoted_cell(text) : text;
}
}  // namespace mill
