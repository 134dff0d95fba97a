#include "twin/records/csv_layout.h"
#include "core/base/csv_cells.h"
#include "core/base/valid_text.h"
#include "twin/records/number_style.h"
#include "twin/records/time_zone.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill::twin {
namespace {
bool is_skipped(const std::string &line)
{
  return csv::without_blanks(line).empty() || line.front() == '#';
}

struct Cells {
  std::deque<std::string> unquoted;
  std::vector<std::string_view> cells;
  Cells(const std::string &line, const char separator)
  {
    split_cells(line, separator, unquoted, cells);
  }
};

// What each cell of a row holds.
std::vector<CellKind> kinds_of(const Cells &row)
{
  std::vector<CellKind> kinds;
  for (const auto cell : row.cells)
    kinds.push_back(kind_of_cell(cell));
  return kinds;
}

bool has(const std::vector<CellKind> &kinds, const CellKind kind)
{
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

// A quote that is open at the end of a line: a cell goes on in the next one.
void refuse_open_quote(const std::string &file, const std::vector<std::string> &lines, const int i,
                       const char separator)
{
  const std::string_view line = lines[std::size_t(i)];
  std::deque<std::string> unquoted;
  const auto fault = csv::each_cell(line, separator, unquoted, [](std::string_view, std::size_t) {});
  if (fault && std::count(line.begin() + std::ptrdiff_t(fault->position), line.end(), '"') % 2 == 1)
    throw InputError(Place{file, i + 1, 1 + csv::characters_in(line.substr(0, fault->position))},
                     std::string(fault->message) + "; each row of a record is one line, also that of the names");
}

// Bytes that no text has, as in a spreadsheet or an archive, or in UTF-16 that does not say so.
void refuse_binary(const std::string &file, const std::vector<std::string> &lines)
{
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].find('\0') != std::string::npos)
      throw InputError(
          Place{file, int(i) + 1, 1},
          "this is not a text: it holds bytes of value zero; export the record as CSV in UTF-8, or in "
          "UTF-16 with a byte-order mark");
}

// Could the second row stand below the first one in a table: as many cells, of the same kind where both have one?
bool go_together(const std::vector<CellKind> &one, const std::vector<CellKind> &other)
{
  if (one.size() != other.size())
    return false;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (one[i] != other[i] && one[i] != CellKind::missing && other[i] != CellKind::missing)
      return false;
  return true;
}

int next_line(const std::vector<std::string> &lines, int i)
{
  for (++i; i < int(lines.size()) && is_skipped(lines[std::size_t(i)]); ++i) {
  }
  return i;
}

int line_before(const std::vector<std::string> &lines, int i)
{
  for (--i; i >= 0 && is_skipped(lines[std::size_t(i)]); --i) {
  }
  return i;
}

// A row of numbers and times alone, or one with texts among them below a row of as many names.
bool begins_data(const std::vector<std::string> &lines, const int i, const char separator, const std::size_t least)
{
  const auto kinds = kinds_of(Cells(lines[std::size_t(i)], separator));
  if (kinds.size() < least || !(has(kinds, CellKind::number) || has(kinds, CellKind::time)))
    return false;
  const int next = next_line(lines, i), last = int(lines.size());
  if (!has(kinds, CellKind::text))
    return next == last || Cells(lines[std::size_t(next)], separator).cells.size() == kinds.size();
  const int before = line_before(lines, i), after = next < last ? next_line(lines, next) : last;
  if (kinds.size() < 2 || before < 0)
    return false;
  const auto above = kinds_of(Cells(lines[std::size_t(before)], separator));
  const auto below = [&](const int row) {
    return row == last || go_together(kinds, kinds_of(Cells(lines[std::size_t(row)], separator)));
  };
  return above.size() == kinds.size() && !has(above, CellKind::number) && !has(above, CellKind::time) &&
         below(next) && below(after);
}

// Index of the first row of numbers; -1: none.
int first_data(const std::vector<std::string> &lines, const char separator, const std::size_t least)
{
  for (int i = 0; i < int(lines.size()); ++i)
    if (!is_skipped(lines[std::size_t(i)]) && begins_data(lines, i, separator, least))
      return i;
  return -1;
}

std::string unit_in_cell(std::string_view cell)
{
  if (cell.size() > 2 && (cell.front() == '[' || cell.front() == '('))
    cell = cell.substr(1, cell.size() - 2);
  return trimmed_cell(valid_text(cell));
}

// A row below the names that holds units, known ones and others.
bool is_unit_row(const Cells &row, const Cells &names)
{
  int known = 0, alike = 0, others = 0;
  bool all_in_brackets = true, time_in_seconds = false;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string unit = unit_in_cell(row.cells[i]);
    if (unit.empty() || unit == "-")
      continue;
    all_in_brackets         = all_in_brackets && (row.cells[i].front() == '[' || row.cells[i].front() == '(');
    const bool in_seconds   = seconds_per(unit) > 0;
    const bool of_time_name = i < names.cells.size() && time_name(std::string(names.cells[i])) != TimeName::none;
    time_in_seconds         = time_in_seconds || (in_seconds && of_time_name);
    if (in_seconds || unit_of_column(unit, "").known)
      ++known;
    else if (looks_like_unit(unit))
      ++alike;
    else
      ++others;
  }
  if (known + alike + others == 0)
    return false;
  const auto above     = kinds_of(names);
  const bool are_names = !has(above, CellKind::number) && !has(above, CellKind::time);
  const bool mostly    = known > 0 && (others == 0 || (time_in_seconds && known + alike >= others));
  return all_in_brackets || (mostly && (are_names || time_in_seconds));  // oscilloscopes call a channel "1"
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
  int names = line_before(lines, data);
  if (names < 0)
    throw InputError(Place{file, data + 1, 1},
                     "the columns have no names; put a line such as \"time [s], force [kN], upper_work_roll [g]\" "
                     "before the numbers");
  for (const int line : {line_before(lines, names), names})
    if (line >= 0)
      refuse_open_quote(file, lines, line, layout.separator);
  Cells head(lines[std::size_t(names)], layout.separator), units("", layout.separator);
  if (const int above = line_before(lines, names); above >= 0) {
    Cells over(lines[std::size_t(above)], layout.separator);
    if (over.cells.size() == head.cells.size() && is_unit_row(head, over)) {
      layout.notes.push_back(fmt::format("units were taken from line {}, below the names", names + 1));
      units = Cells(lines[std::size_t(names)], layout.separator);
      names = above;
      head  = Cells(lines[std::size_t(names)], layout.separator);
    }
  }
  const std::string &line = lines[std::size_t(names)];
  for (std::size_t c = 0; c < head.cells.size(); ++c) {
    ColumnHead name = head_of(head.cells[c]);
    if (name.unit.empty() && c < units.cells.size())
      name.unit = unit_in_cell(units.cells[c]);
    if (name.unit.empty())
      name.unit = unit_above(lines, std::size_t(names), layout.separator,
                             time_name(name.name) != TimeName::none ? "horizontal units" : "vertical units", c);
    layout.columns.push_back({name, {file, names + 1, column_of(line, head.cells[c], c, layout.separator)}});
  }
  if (names > 0)
    layout.notes.push_back(
        fmt::format("the names of the columns are in line {}; what is above was not used", names + 1));
}
}  // namespace

void split_cells(const std::string_view line, const char separator, std::deque<std::string> &unquoted,
                 std::vector<std::string_view> &cells)
{
  cells.clear();
  csv::each_cell(line, separator, unquoted,
                 [&](const std::string_view text, std::size_t) { cells.push_back(text); });
}

int column_of(const std::string_view line, const std::string_view cell, const std::size_t index,
              const char separator)
{
  std::size_t position = 0;
  if (cell.data() >= line.data() && cell.data() <= line.data() + line.size())
    position = std::size_t(cell.data() - line.data());
  else
    for (std::size_t i = 0; i < index && position < line.size(); ++position)
      i += line[position] == separator;
  return 1 + csv::characters_in(line.substr(0, position));
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

CellKind kind_of_cell(const std::string_view cell)
{
  if (styles_of(cell) != 0)
    return CellKind::number;
  if (is_missing(cell))
    return CellKind::missing;
  return time_of_text(cell) || time_of_text(std::string(cell) + " 0:00") ? CellKind::time : CellKind::text;
}

CsvLayout layout_of(const std::string &file, const std::vector<std::string> &lines)
{
  CsvLayout layout;
  if (lines.empty() || std::all_of(lines.begin(), lines.end(), is_skipped))
    throw InputError(Place{file, 1, 1}, "the file is empty; a line such as \"time [s], force [kN], "
                                        "upper_work_roll [g]\" and numbers are needed");
  int data = -1;
  for (const auto &[separator, least] :
       {std::pair(';', 2u), std::pair('\t', 2u), std::pair(',', 2u), std::pair(' ', 2u), std::pair(',', 1u)}) {
    layout.separator = separator;
    if (data = first_data(lines, separator, least); data >= 0)
      break;
  }
  if (data < 0) {
    refuse_binary(file, lines);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const char separator : {';', '\t', ','})
        refuse_open_quote(file, lines, int(i), separator);
    throw InputError(Place{file, 1, 1},
                     fmt::format("no row of numbers {}; columns are separated by ';', tab, "
                                 "',' or blanks; a decimal comma needs one of the first two",
                                 lines.size() == 1 ? "in the first line"
                                                   : fmt::format("among the first {} lines", lines.size())));
  }
  take_heads(layout, file, lines, data);
  layout.first_data_line = data + 1;
  return layout;
}
}  // namespace mill::twin
