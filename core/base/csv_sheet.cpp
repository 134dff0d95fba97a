#include "core/base/csv_sheet.h"
#include "core/base/text.h"
#include "core/base/valid_text.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::csv {
namespace {
// The first of these that stands outside quotes separates the columns.
char separator_of(const std::string_view line)
{
  for (const char separator : {';', '\t', ','}) {
    bool in_quotes = false;
    for (const char c : line) {
      in_quotes = in_quotes != (c == '"');
      if (c == separator && !in_quotes)
        return separator;
    }
  }
  return ',';
}

// Appends the cells of a line and returns how many; the column of each is counted in characters.
std::size_t add_cells(Sheet &sheet, std::vector<Cell> &all, const std::string_view line, const int number)
{
  const std::size_t before = all.size();
  std::size_t counted      = 0;
  int column               = 1;
  const auto fault =
      each_cell(line, sheet.separator, sheet.unquoted, [&](const std::string_view text, const std::size_t begin) {
        column += characters_in(line.substr(counted, begin - counted));
        counted = begin;
        all.push_back({text, number, column});
      });
  if (fault)
    throw InputError({sheet.file, number, 1 + characters_in(line.substr(0, fault->position))}, fault->message);
  return all.size() - before;
}

// "force [kN]" -> name and unit.
Header header_of(const Cell &cell)
{
  const auto open = cell.text.rfind('[');
  if (open == std::string_view::npos || cell.text.back() != ']')
    return {std::string(cell.text), "", false, cell.line, cell.column};
  return {std::string(without_blanks(cell.text.substr(0, open))),
          std::string(without_blanks(cell.text.substr(open + 1, cell.text.size() - open - 2))), true, cell.line,
          cell.column};
}
}  // namespace

Sheet sheet_of(const std::string &file, std::string text, const std::string &example)
{
  Sheet sheet;
  sheet.file = file;
  TextEncoding encoding{};
  sheet.text            = std::make_unique<const std::string>(valid_file_text(std::move(text), encoding));
  std::string_view rest = *sheet.text;
  if (rest.rfind(utf8_mark, 0) == 0) {
    rest.remove_prefix(utf8_mark.size());
    sheet.notes.push_back("a byte-order mark at the beginning of the file was ignored");
  }
  if (encoding != TextEncoding::utf8)
    sheet.notes.push_back(std::string("the file is ") + word_of(encoding));
  int number = 0, n_blank = 0;
  while (!rest.empty()) {
    ++number;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    if (without_blanks(line).empty()) {
      ++n_blank;
      continue;
    }
    if (line.front() == '#')
      continue;
    if (sheet.header.empty()) {
      sheet.separator = separator_of(line);
      std::vector<Cell> cells;
      add_cells(sheet, cells, line, number);
      for (const Cell &cell : cells)
        sheet.header.push_back(header_of(cell));
      sheet.cells.reserve(cells.size() * std::size_t(1 + std::count(rest.begin(), rest.end(), '\n')));
      continue;
    }
    if (const auto n = add_cells(sheet, sheet.cells, line, number); n != sheet.header.size())
      throw InputError(Place{file, number, 1},
                       fmt::format("this line has {} cells, the header has {}; a decimal comma needs ';' or tab "
                                   "between the columns",
                                   n, sheet.header.size()));
  }
  if (sheet.header.empty())
    throw InputError(Place{file, 1, 1},
                     fmt::format("the file is empty; a header such as \"{}\" and data are needed", example));
  if (n_blank > 0)
    sheet.notes.push_back(fmt::format("{} blank line{} skipped", n_blank, n_blank == 1 ? " was" : "s were"));
  return sheet;
}

double number_of(const Cell &cell, const std::string &name, Sheet &sheet)
{
  if (cell.text.empty())
    throw InputError(sheet.place(cell), fmt::format("the cell of column '{}' is empty; a number is needed", name));
  std::string_view text = cell.text;
  std::string with_point;
  if (sheet.separator != ',')
    if (const auto comma = text.find(','); comma != std::string_view::npos) {
      with_point          = text;
      with_point[comma]   = '.';
      text                = with_point;
      sheet.decimal_comma = true;
    }
  double number = 0;
  if (!parse_number(text, number) || std::abs(number) > largest_in_cell)
    throw InputError(sheet.place(cell),
                     fmt::format("'{}' in column '{}' is not a finite number", cell.text, name));
  return number;
}

std::size_t index_of(const Sheet &sheet, const std::string &name, const std::string &sample)
{
  std::string names;
  for (std::size_t i = 0; i < sheet.header.size(); ++i) {
    if (sheet.header[i].name == name)
      return i;
    names += (names.empty() ? "'" : ", '") + sheet.header[i].name + "'";
  }
  throw InputError(sheet.place(sheet.header.front()),
                   fmt::format("no column '{}' in the header, which has {}; write for example \"{}{}\"", name,
                               names, name, sample.empty() ? "" : " [" + sample + "]"));
}

const Unit &unit_of(const Sheet &sheet, const Header &header, const std::string &sample)
{
  const Unit &wanted = unit(sample);
  const auto remedy  = fmt::format("{} is needed, for example \"{} [{}]\"", wanted.quantity, header.name, sample);
  if (!header.has_unit || header.unit.empty())
    throw InputError(sheet.place(header), fmt::format("column '{}' has no unit; {}", header.name, remedy));
  const Unit *in_table = find_unit(header.unit);
  if (!in_table)
    throw InputError(sheet.place(header),
                     fmt::format("column '{}' has the unknown unit '{}'; {}", header.name, header.unit, remedy));
  if (!(in_table->dimension == wanted.dimension))
    throw InputError(sheet.place(header), fmt::format("column '{}' has the unit '{}', {}; {}", header.name,
                                                      header.unit, in_table->quantity, remedy));
  return *in_table;
}
}  // namespace mill::csv
