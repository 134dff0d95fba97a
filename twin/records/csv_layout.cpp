#include "twin/records/csv_layout.h"
#include "twin/records/time_zone.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
std::string_view without_blanks(std::string_view text)
{
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

bool is_skipped(const std::string &line)
{
  return without_blanks(line).empty() || line.front() == '#';
}

struct Cells {
  std::deque<std::string> unquoted;
  std::vector<std::string_view> cells;
  Cells(const std::string &line, const char separator)
  {
    split_cells(line, separator, unquoted, cells);
  }
};

// A row of numbers and times, at least one of them, and nothing else.
bool is_data(const std::string &line, const char separator)
{
  const Cells row(line, separator);
  bool any = false;
  for (const auto cell : row.cells) {
    double number = 0;
    bool comma    = false;
    const bool is = number_of_cell(cell, separator, number, comma) || time_of_text(cell) ||
                    time_of_text(std::string(cell) + " 0:00");
    if (!is && !is_missing(cell))
      return false;
    any = any || is;
  }
  return any;
}

bool is_unit_row(const Cells &row)
{
  bool any = false;
  for (auto cell : row.cells) {
    if (cell.size() > 2 && (cell.front() == '[' || cell.front() == '('))
      cell = cell.substr(1, cell.size() - 2);
    const std::string unit(cell);
    if (unit.empty() || unit == "-")
      continue;
    if (!unit_of_column(unit, "").known && seconds_per(unit) == 0)
      return false;
    any = true;
  }
  return any;
}

// Index of the first row of numbers, as many cells as the next; -1: none.
int first_data(const std::vector<std::string> &lines, const char separator, const std::size_t least)
{
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_skipped(lines[i]) || !is_data(lines[i], separator))
      continue;
    const std::size_t n = Cells(lines[i], separator).cells.size();
    std::size_t next    = i + 1;
    while (next < lines.size() && is_skipped(lines[next]))
      ++next;
    const bool goes_on = next < lines.size() && Cells(lines[next], separator).cells.size() == n;
    if (n >= least && (goes_on || next == lines.size()))
      return int(i);
  }
  return -1;
}

// "Vertical Units,V" above the columns of an oscilloscope.
std::string unit_above(const std::vector<std::string> &lines, const std::size_t below, const char separator,
                       const char *key, const std::size_t column)
{
  for (std::size_t i = 0; i < below; ++i) {
    const Cells row(lines[i], separator);
    if (row.cells.size() > 1 && lower(row.cells[0]) == key)
      return std::string(row.cells[std::min(std::max<std::size_t>(1, column), row.cells.size() - 1)]);
  }
  return "";
}

void take_heads(CsvLayout &layout, const std::string &file, const std::vector<std::string> &lines, const int data)
{
  int names = data - 1;
  while (names >= 0 && is_skipped(lines[std::size_t(names)]))
    --names;
  if (names < 0)
    throw InputError(Place{file, data + 1, 1},
                     "the columns have no names; put a line such as \"time [s], force [kN], upper_work_roll [g]\" "
                     "before the numbers");
  Cells head(lines[std::size_t(names)], layout.separator), units("", layout.separator);
  if (is_unit_row(head)) {
    int above = names - 1;
    while (above >= 0 && is_skipped(lines[std::size_t(above)]))
      --above;
    if (above >= 0 && Cells(lines[std::size_t(above)], layout.separator).cells.size() == head.cells.size()) {
      units = Cells(lines[std::size_t(names)], layout.separator);
      names = above;
      head  = Cells(lines[std::size_t(names)], layout.separator);
      layout.notes.push_back(fmt::format("units were taken from line {}, below the names", names + 2));
    }
  }
  const std::string &line = lines[std::size_t(names)];
  for (std::size_t c = 0; c < head.cells.size(); ++c) {
    bool converted  = false;
    ColumnHead name = head_of(utf8_of(head.cells[c], converted));
    if (converted && layout.notes.empty())
      layout.notes.push_back("the names of the columns are no UTF-8 and were read as Windows-1252");
    if (name.unit.empty() && c < units.cells.size()) {
      std::string unit = utf8_of(units.cells[c], converted);
      if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '('))
        unit = unit.substr(1, unit.size() - 2);
      name.unit = unit;
    }
    if (name.unit.empty())
      name.unit = unit_above(lines, std::size_t(names), layout.separator,
                             is_time_name(name.name) ? "horizontal units" : "vertical units", c);
    layout.columns.push_back({
        name, {file, names + 1, column_of(line, head.cells[c], c, layout.separator)}
    });
  }
  if (names > 0)
    layout.notes.push_back(
        fmt::format("the names of the columns stand in line {}; what is above was not used", names + 1));
}
}  // namespace

void split_cells(const std::string_view line, const char separator, std::deque<std::string> &unquoted,
                 std::vector<std::string_view> &cells)
{
  cells.clear();
  unquoted.clear();
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && line[at] == ' ')
      ++at;
    if (at < line.size() && line[at] == '"') {
      std::string &text = unquoted.emplace_back();
      for (++at; at < line.size(); ++at) {
        if (line[at] != '"')
          text += line[at];
        else if (at + 1 < line.size() && line[at + 1] == '"')
          text += line[++at];
        else
          break;
      }
      at = std::min(line.find(separator, std::min(at, line.size())), line.size());
      cells.push_back(without_blanks(text));
    } else {
      const auto end = std::min(line.find(separator, at), line.size());
      cells.push_back(without_blanks(line.substr(at, end - at)));
      at = end;
    }
    if (at >= line.size())
      return;
    ++at;
  }
}

int column_of(const std::string_view line, const std::string_view cell, const std::size_t index,
              const char separator)
{
  std::size_t at = 0;
  if (cell.data() >= line.data() && cell.data() <= line.data() + line.size())
    at = std::size_t(cell.data() - line.data());
  else
    for (std::size_t i = 0; i < index && at < line.size(); ++at)
      i += line[at] == separator;
  const auto before = line.substr(0, std::min(at, line.size()));
  return 1 + int(std::count_if(before.begin(), before.end(), [](const char c) { return (c & 0xC0) != 0x80; }));
}

bool is_missing(const std::string_view cell)
{
  if (cell.empty())
    return true;
  if (cell.size() > 8)
    return false;
  const std::string word = lower(cell);
  for (const char *known : {"nan", "null", "na", "n/a", "#n/a", "#nv", "-", "--", "none", "inf", "-inf", "+inf",
                            "1.#qnan", "-1.#ind", "-nan"})
    if (word == known)
      return true;
  return false;
}

bool number_of_cell(const std::string_view cell, const char separator, double &number, bool &had_comma)
{
  std::string_view text = cell;
  char copy[64];
  constexpr std::string_view minus_sign = "\u2212";  // which spreadsheets write in some locales
  if (text.substr(0, minus_sign.size()) == minus_sign) {
    text.remove_prefix(minus_sign.size() - 1);
    if (text.size() > sizeof copy)
      return false;
    copy[0] = '-';
    std::copy(text.begin() + 1, text.end(), copy + 1);
    text = {copy, text.size()};
  }
  if (separator != ',')
    if (const auto comma = text.find(','); comma != std::string_view::npos) {
      if (text.size() > sizeof copy || text.find('.') != std::string_view::npos)
        return false;                             // 1.234,5: thousands or a slip, two readings
      std::copy(text.begin(), text.end(), copy);  // onto itself behind a minus sign
      copy[comma] = '.';
      text        = {copy, text.size()};
      had_comma   = true;
    }
  if (!text.empty() && text.front() == '+')
    text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && !text.empty() && std::isfinite(number);
}

CsvLayout layout_of(const std::string &file, const std::vector<std::string> &lines)
{
  CsvLayout layout;
  if (lines.empty() || std::all_of(lines.begin(), lines.end(), is_skipped))
    throw InputError(Place{file, 1, 1}, "the file is empty; a line such as \"time [s], force [kN], "
                                        "upper_work_roll [g]\" and numbers are needed");
  int data = -1;
  for (const auto &[separator, least] :
       {std::pair(';', 2u), std::pair('\t', 2u), std::pair(',', 2u), std::pair(',', 1u)}) {
    layout.separator = separator;
    if (data = first_data(lines, separator, least); data >= 0)
      break;
  }
  if (data < 0)
    throw InputError(
        Place{file, 1, 1},
        fmt::format("no row of numbers among the first {} lines; columns are separated by ';', tab or "
                    "',', a decimal comma needs one of the first two",
                    lines.size()));
  take_heads(layout, file, lines, data);
  layout.first_data_line = data + 1;
  return layout;
}
}  // namespace mill::twin
