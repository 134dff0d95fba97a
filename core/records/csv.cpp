#include "core/records/csv.h"
#include "core/case/errors.h"
#include "core/case/units.h"
#include "core/records/files.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <memory>
#include <string_view>

namespace mill {
namespace {
constexpr double largest_in_cell = 1e15;  // nothing a mill records reaches this in any unit

// A cell with its place; the column counts characters.  Its text stays where it is in the file: a record of 100 s
// has millions of cells.
struct Cell {
  std::string_view text;
  int line, column;
};

struct Header {
  std::string name, unit;
  bool has_unit;
  int line, column;
};

// A text file taken apart: header and rows of cells, blank and comment lines left out.
struct Sheet {
  std::string file;
  std::unique_ptr<const std::string> text;  // what the cells look into; on the heap, so that a sheet can move
  std::deque<std::string> unquoted;         // cells with doubled quotes, which stand so nowhere in the text
  std::vector<Header> header;
  std::vector<Cell> cells;  // row by row, as many in each as the header has
  char separator     = ',';
  bool decimal_comma = false;
  std::vector<std::string> notes;
  std::size_t n_rows() const
  {
    return cells.size() / header.size();
  }
  const Cell &cell(const std::size_t row, const std::size_t column) const
  {
    return cells[row * header.size() + column];
  }
  template <class CellOrHeader> Place place(const CellOrHeader &at) const
  {
    return {file, at.line, at.column};
  }
};

std::string_view without_blanks(std::string_view text)
{
  const auto is_blank = [](const char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

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

// The cells of one line, quoted as in RFC 4180 or as they stand.
class CellReader {
public:
  CellReader(Sheet &sheet, const std::string_view line, const int number)
      : file_(sheet.file), unquoted_(sheet.unquoted), line_(line), separator_(sheet.separator), number_(number)
  {
  }
  // Appends them and tells how many.
  std::size_t add_to(std::vector<Cell> &all)
  {
    const std::size_t before = all.size();
    do {
      skip_blanks();
      const int column = column_;
      all.push_back({at_ < line_.size() && line_[at_] == '"' ? quoted_text() : plain_text(), number_, column});
    } while (step_over_separator());
    return all.size() - before;
  }

private:
  void skip_blanks()
  {
    while (at_ < line_.size() && line_[at_] != separator_ && (line_[at_] == ' ' || line_[at_] == '\t'))
      step();
  }
  void step()
  {
    column_ += (line_[at_++] & 0xC0) != 0x80;  // characters, not bytes
  }
  bool step_over_separator()
  {
    if (at_ == line_.size())
      return false;
    step();
    return true;
  }
  std::string_view plain_text()
  {
    const std::size_t begin = at_;
    while (at_ < line_.size() && line_[at_] != separator_)
      step();
    return without_blanks(line_.substr(begin, at_ - begin));
  }
  // Between quotes, a doubled one standing for itself.
  std::string_view quoted_text()
  {
    const Place open{file_, number_, column_};
    std::string text;
    step();
    while (true) {
      if (at_ == line_.size())
        throw InputError(open, "this quote is not closed on its line");
      const char c = line_[at_];
      step();
      if (c != '"')
        text += c;
      else if (at_ < line_.size() && line_[at_] == '"') {
        text += '"';
        step();
      } else
        break;
    }
    skip_blanks();
    if (at_ < line_.size() && line_[at_] != separator_)
      throw InputError({file_, number_, column_},
                       "something follows a closing quote; a quote inside quotes is doubled");
    return without_blanks(unquoted_.emplace_back(std::move(text)));
  }

  const std::string &file_;
  std::deque<std::string> &unquoted_;
  std::string_view line_;
  char separator_;
  int number_, column_ = 1;
  std::size_t at_ = 0;
};

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

Sheet sheet_of(const std::string &path)
{
  Sheet sheet;
  sheet.file            = path;
  sheet.text            = std::make_unique<const std::string>(read_text(path));
  std::string_view rest = *sheet.text;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") {
    rest.remove_prefix(3);
    sheet.notes.push_back("a byte-order mark at the beginning of the file was ignored");
  }
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
      CellReader(sheet, line, number).add_to(cells);
      for (const Cell &cell : cells)
        sheet.header.push_back(header_of(cell));
      sheet.cells.reserve(cells.size() * std::size_t(1 + std::count(rest.begin(), rest.end(), '\n')));
      continue;
    }
    if (const auto n = CellReader(sheet, line, number).add_to(sheet.cells); n != sheet.header.size())
      throw InputError(Place{path, number, 1},
                       fmt::format("this line has {} cells, the header has {}; a decimal comma needs ';' or tab "
                                   "between the columns",
                                   n, sheet.header.size()));
  }
  if (sheet.header.empty())
    throw InputError(Place{path, 1, 1},
                     "the file is empty; a header such as \"time [s], force [kN]\" and data are needed");
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
                   fmt::format("no column '{}' in the header, which has {}; write for example \"{} [{}]\"", name,
                               names, name, sample));
}

const Unit &unit_of(const Sheet &sheet, const Header &header, const std::string &sample)
{
  const Unit &wanted = unit(sample);
  const auto remedy  = fmt::format("{} is needed, for example \"{} [{}]\"", wanted.quantity, header.name, sample);
  if (!header.has_unit || header.unit.empty())
    throw InputError(sheet.place(header), fmt::format("column '{}' has no unit; {}", header.name, remedy));
  const Unit *found = find_unit(header.unit);
  if (!found)
    throw InputError(sheet.place(header),
                     fmt::format("column '{}' has the unknown unit '{}'; {}", header.name, header.unit, remedy));
  if (!(found->dimension == wanted.dimension))
    throw InputError(sheet.place(header), fmt::format("column '{}' has the unit '{}', {}; {}", header.name,
                                                      header.unit, found->quantity, remedy));
  return *found;
}

// One column in SI; `sample` names the wanted dimension and is shown as the example.
Eigen::VectorXd column_of(Sheet &sheet, const std::string &name, const std::string &sample)
{
  const std::size_t c = index_of(sheet, name, sample);
  const Unit &u       = unit_of(sheet, sheet.header[c], sample);
  Eigen::VectorXd values(Eigen::Index(sheet.n_rows()));
  for (std::size_t r = 0; r < sheet.n_rows(); ++r)
    values[Eigen::Index(r)] = to_si(number_of(sheet.cell(r, c), name, sheet), u);
  return values;
}

void require_increasing(const Sheet &sheet, const Eigen::VectorXd &time)
{
  if (time.size() < 2)
    throw InputError(Place{sheet.file, sheet.header.front().line, 1},
                     fmt::format("{} after this header; at least two are needed",
                                 time.size() == 0 ? "no sample" : "only one sample"));
  const auto is_time = [](const Header &h) { return h.name == "time"; };
  const auto c =
      std::size_t(std::find_if(sheet.header.begin(), sheet.header.end(), is_time) - sheet.header.begin());
  const auto unit_txt = sheet.header[c].unit;
  for (Eigen::Index i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1])) {
      const Cell &cell = sheet.cell(std::size_t(i), c), &before = sheet.cell(std::size_t(i - 1), c);
      const auto message =
          time[i] == time[i - 1]
              ? fmt::format("time {} {} stands twice; keep one of the two lines", cell.text, unit_txt)
              : fmt::format("time {} {} comes after {} {}; sort the lines by time", cell.text, unit_txt,
                            before.text, unit_txt);
      throw InputError(std::vector<Problem>{
          {sheet.place(cell), message, {sheet.place(before)}}
      });
    }
}

// "name [unit]" as a cell of one line, in quotes where RFC 4180 wants them or where the reader would take it for
// something else. A name that ends like a unit gets an empty one.
std::string header_text(std::string name, const std::string &unit)
{
  for (char &c : name)
    if (c == '\n' || c == '\r')
      c = ' ';
  const bool like_a_unit = unit.empty() && !name.empty() && name.back() == ']';
  const std::string cell = name + (like_a_unit ? " []" : unit.empty() ? "" : " [" + unit + "]");
  const bool plain       = cell.find_first_of(",;\t\"") == std::string::npos && cell.rfind('#', 0) != 0;
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
  if (!std::isfinite(value)) {
    text += number_text(value);
    return;
  }
  char digits[64];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

std::vector<std::string> notes_of(const Sheet &sheet)
{
  auto notes = sheet.notes;
  if (sheet.decimal_comma)
    notes.push_back("decimal commas were read as decimal points");
  return notes;
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
    text += '\n';
  }
  return text;
}

bool reads_back(const Table &table)
{
  const auto plain = [](const std::string &text) {
    return text == without_blanks(text) && text.find_first_of("\n\r\"[]") == std::string::npos;
  };
  if (table.columns.empty() || table.columns.front().size() == 0)
    return false;  // a file without rows has its own rules
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.names[c].empty() || !plain(table.names[c]) || !plain(table.units[c]))
      return false;
    for (const double value : table.columns[c])
      if (std::abs(value) > largest_in_cell)  // not true of NaN, which is read as such
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
      values[Eigen::Index(r)] = cell.text == "nan" ? std::numeric_limits<double>::quiet_NaN()
                                                   : number_of(cell, sheet.header[c].name, sheet);
    }
    table.columns.push_back(std::move(values));
  }
  return table;
}

ForceRecord read_force(const std::string &path)
{
  Sheet sheet = sheet_of(path);
  ForceRecord record;
  record.time  = column_of(sheet, "time", "s");
  record.force = column_of(sheet, "force", "kN");
  require_increasing(sheet, record.time);
  record.notes = notes_of(sheet);
  return record;
}

MeasuredRecord read_measured(const std::string &path)
{
  Sheet sheet = sheet_of(path);
  MeasuredRecord record;
  record.time            = column_of(sheet, "time", "s");
  record.upper_work_roll = column_of(sheet, "upper_work_roll", "g");
  record.lower_work_roll = column_of(sheet, "lower_work_roll", "g");
  require_increasing(sheet, record.time);
  record.notes = notes_of(sheet);
  return record;
}
}  // namespace mill
