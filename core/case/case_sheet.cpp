#include "core/case/case_sheet.h"
#include "core/base/csv_cells.h"
#include "core/base/error_list.h"
#include "core/base/units.h"
#include "core/case/case_template.h"
#include "core/case/quantity_slips.h"
#include "core/case/removed_keys.h"
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <set>

namespace mill {
namespace {
using Repeat = SectionRows::Repeat;

struct SheetRow {
  std::vector<std::string> cells;
  int line = 0;
};

// What follows the key, which has no such sign: behind it ';' may separate the values of a pair.
char separator_of(const std::string &line)
{
  const auto first = line.find_first_of("\t;,");
  return first == std::string::npos ? ',' : line[first];
}

std::string stripped(const std::string &text)
{
  return std::string(csv::without_blanks(text));
}

// Cells of a line up to the last that holds something.
std::vector<std::string> cells_of(const std::string &line, const char separator, const Place &start)
{
  std::vector<std::string> cells;
  std::deque<std::string> unquoted;
  const auto fault = csv::each_cell(line, separator, unquoted,
                                    [&](const std::string_view text, std::size_t) { cells.emplace_back(text); });
  if (fault)
    throw InputError(Place{start.file, start.line, 1 + csv::characters_in(line.substr(0, fault->position))},
                     fault->message);
  while (!cells.empty() && cells.back().empty())
    cells.pop_back();
  return cells;
}

std::vector<SheetRow> rows_of_sheet(const std::string &file, std::string text)
{
  if (text.rfind("\xef\xbb\xbf", 0) == 0)
    text.erase(0, 3);
  std::vector<SheetRow> rows;
  char separator = 0;
  int number     = 0;
  for (const std::string &line : split(text, "\n")) {
    ++number;
    if (const std::string bare = stripped(line); bare.empty() || bare[0] == '#')
      continue;
    if (!separator)
      separator = separator_of(line);
    const auto cells = cells_of(line, separator, {file, number, 1});
    if (!cells.empty() && !(rows.empty() && (cells[0] == "key" || cells[0] == "Key" || cells[0] == "KEY")))
      rows.push_back({cells, number});
  }
  return rows;
}

// Where a full key leads in the template: the section as filled, and the row.
struct Target {
  FilledSection *filled = nullptr;
  const Row *row        = nullptr;
};

// "[bearing.trb]" -> "trb", "[bearing.\"trb 1.a\"]" -> "trb 1.a"
std::string name_in(const std::string &header)
{
  const auto dot = header.find('.');
  if (dot == std::string::npos)
    return "";
  const bool in_quotes = header[dot + 1] == '"';
  return header.substr(dot + 1 + in_quotes, header.rfind(']') - dot - 1 - 2 * in_quotes);
}

class SheetReader {
public:
  SheetReader(const CaseKind &case_kind, std::string file) : kind(case_kind), sections(filled_sections(case_kind))
  {
    reading.file = std::move(file);
  }
  void take(const SheetRow &row);
  bool decimal_commas = false;  ///< some number of the sheet has one
  std::string text()
  {
    if (!reading.problems.empty())
      throw InputError(std::move(reading.problems));
    return template_text(kind, sections);
  }

private:
  const CaseKind &kind;
  std::vector<FilledSection> sections;
  Reading reading;
  std::set<std::string> seen;

  Target target_of(const std::string &key);
  void set(FilledSection &filled, const std::string &key, const std::string &value);
  FilledSection *named(const SectionRows &section, const std::string &name);
  FilledSection *numbered(const SectionRows &section, std::size_t i);
  std::vector<std::string> known_keys() const;
  std::string near_key(const std::string &key) const
  {
    if (const std::string removal = removal_note(key.substr(key.rfind('.') + 1)); !removal.empty())
      return removal;
    const std::string near = nearest_word(key, known_keys());
    return near.empty() ? "; the template and docs/input.md have the keys of each section"
                        : "; did you mean '" + near + "'?";
  }
};

// A section of this name, added behind its like when the template has none.
FilledSection *SheetReader::named(const SectionRows &section, const std::string &name)
{
  auto last = sections.end();
  for (auto it = sections.begin(); it != sections.end(); ++it)
    if (it->section == &section) {
      last = it;
      if (name_in(it->note.header) == name)
        return &*it;
    }
  if (last == sections.end())
    return nullptr;
  FilledSection added{&section, {}};
  added.note.section = section.id();
  added.note.header  = fmt::format("[{}.{}]", section.name, key_text(name));
  return &*sections.insert(last + 1, added);
}

FilledSection *SheetReader::numbered(const SectionRows &section, const std::size_t i)
{
  std::size_t n = 0;
  auto last     = sections.end();
  for (auto it = sections.begin(); it != sections.end(); ++it)
    if (it->section == &section) {
      if (n++ == i)
        return &*it;
      last = it;
    }
  if (last == sections.end() || i != n)
    return nullptr;
  FilledSection added{&section, {}};
  added.note.section        = section.id();
  added.note.values["name"] = quoted(fmt::format("pass {}", i + 1));
  return &*sections.insert(last + 1, added);
}

Target SheetReader::target_of(const std::string &key)
{
  const auto last           = key.rfind('.');
  const std::string section = last == std::string::npos ? "" : key.substr(0, last),
                    name    = last == std::string::npos ? key : key.substr(last + 1);
  const auto row_in         = [&](const SectionRows &rows) {
    const auto match =
        std::find_if(rows.rows.begin(), rows.rows.end(), [&](const Row &r) { return r.key == name; });
    return match == rows.rows.end() ? nullptr : &*match;
  };
  for (const SectionRows &rows : kind.sections) {
    const Row *row = row_in(rows);
    if (!row)
      continue;
    if (rows.repeat == Repeat::once && rows.name == section)
      for (FilledSection &filled : sections)
        if (filled.section == &rows)
          return {&filled, row};
    if (rows.repeat == Repeat::named && rows.type.empty() && section.rfind(rows.name + ".", 0) == 0)
      return {named(rows, section.substr(rows.name.size() + 1)), row};
    if (rows.repeat == Repeat::list && section == rows.name)
      return {numbered(rows, 0), row};
    const std::string index = section.substr(std::min(rows.name.size() + 1, section.size()));
    if (rows.repeat == Repeat::list && section == rows.name + "." + index && index.size() == 1 &&
        std::isdigit(index[0]))
      return {numbered(rows, std::size_t(index[0] - '0')), row};
  }
  return {};
}

std::vector<std::string> SheetReader::known_keys() const
{
  std::vector<std::string> keys;
  for (const FilledSection &filled : sections)
    for (const Row &row : filled.section->rows) {
      const std::string name = name_in(filled.note.header);
      const std::string section =
          filled.section->repeat == Repeat::named ? filled.section->name + "." + name : filled.section->name;
      if (filled.section->type.empty() && !is_tolerance(row.key))
        keys.push_back(section.empty() ? row.key : section + "." + row.key);
    }
  return keys;
}

bool is_list(const Row &row)
{
  return row.kind == Kind::pair || row.kind == Kind::table || row.kind == Kind::six || row.kind == Kind::list;
}

// Values and unit of a row: "420 mm", "420" and "mm"; of a list also "3.55; 3.65 MN", or "3.55", "3.65" and "MN".
struct CellValues {
  std::vector<std::string> values;  ///< with their units
  bool too_many = false;            ///< more cells than the row can use
};

bool begins_with_number(const std::string &text)
{
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) ||
                           std::string("+-.").find(text[0]) != std::string::npos);
}

// Is there a unit behind the number?
bool has_unit(const std::string &value)
{
  return !value.empty() && !std::isdigit(static_cast<unsigned char>(value.back())) && value.back() != '.';
}

CellValues values_of_row(const Row &row, std::vector<std::string> cells)
{
  CellValues result;
  if (!is_list(row)) {
    result.too_many = cells.size() > 2;
    result.values   = {cells.size() > 1 && !cells[1].empty() ? cells[0] + " " + cells[1] : cells[0]};
    return result;
  }
  std::string unit;
  if (cells.size() > 1 && !begins_with_number(cells.back())) {
    unit = cells.back();
    cells.pop_back();
  }
  for (const std::string &cell : cells)
    for (const std::string &bar : split(cell, "|"))
      for (const std::string &part : split(bar, ";"))
        result.values.push_back(stripped(part));
  while (!result.values.empty() && result.values.back().empty())
    result.values.pop_back();
  if (unit.empty() && !result.values.empty() && has_unit(result.values.back())) {
    const std::string &last = result.values.back();
    unit                    = stripped(last.substr(last.find_last_of("0123456789") + 1));
    if (const auto blank = last.find(' '); blank != std::string::npos)
      unit = stripped(last.substr(blank));  // "9 kg/mm2": the digit belongs to the unit
  }
  for (std::string &value : result.values)
    if (!unit.empty() && begins_with_number(value) && !has_unit(value))
      value += " " + unit;
  return result;
}

// A value as the case file would say it; decimal commas of the sheet's locale become points.
std::string pointed(const std::string &value, const bool decimal_commas)
{
  const auto readings = with_decimal_point(value);
  const bool clear    = readings.size() == 1 || (readings.size() == 2 && decimal_commas);
  return clear ? readings.front() : value;
}

Node node_of_row(const Row &row, const std::vector<std::string> &values, const bool decimal_commas,
                 const Place &place)
{
  Node node;
  node.place = place;
  node.kind  = Node::Kind::text;
  node.text  = row.kind == Kind::text ? values.front() : pointed(values.front(), decimal_commas);
  if (row.kind == Kind::number || row.kind == Kind::count) {
    if (parse_number(node.text, node.number))
      node.kind = row.kind == Kind::count && node.number == double(long(node.number)) ? Node::Kind::integer
                                                                                      : Node::Kind::real;
  } else if (row.kind == Kind::flag && (node.text == "true" || node.text == "false")) {
    node.kind = Node::Kind::flag;
    node.flag = node.text == "true";
  } else if (is_list(row)) {
    node.kind = Node::Kind::array;
    for (const std::string &value : values) {
      Node item;
      item.place = place;
      item.kind  = Node::Kind::text;
      item.text  = pointed(value, decimal_commas);
      node.items.push_back(item);
    }
  }
  return node;
}

std::string toml_of_node(const Node &node)
{
  if (node.kind == Node::Kind::text)
    return quoted(node.text);
  if (node.kind != Node::Kind::array)
    return shown(node);
  std::string list;
  for (const Node &item : node.items)
    list += (list.empty() ? "" : ", ") + quoted(item.text);
  return "[" + list + "]";
}

// A value of the sheet, and the keys of the template that it excludes.
void SheetReader::set(FilledSection &filled, const std::string &key, const std::string &value)
{
  TemplateNote &note = filled.note;
  const auto drop    = [&](const std::string &key) {
    if (seen.count(name_in(note.header) + "/" + key) > 0)
      return;  // the sheet gives it too
    note.values.erase(key);
    note.shown.erase(std::remove(note.shown.begin(), note.shown.end(), key), note.shown.end());
  };
  seen.insert(name_in(note.header) + "/" + key);
  note.values[key] = value;
  if (filled.section->name == "pass" && (key == "load" || key == "force"))
    for (const char *made : {"synthetic", "synthetic_range", "synthetic_seed"})
      drop(made);
  if (key == "designation")
    for (const Row &row : filled.section->rows)
      drop(row.key);
  if (key == "type" && value.find("cylindrical") != std::string::npos)
    for (const char *angle : {"roller_cone_angle", "cup_angle"})
      drop(angle);
}

// "1.230 mm" among decimal commas.
std::string ambiguous_point(const std::string &key, const std::string &value, const std::vector<std::string> &two)
{
  std::string with_comma           = two[0];
  with_comma[with_comma.find('.')] = ',';
  return fmt::format(
      "{} = {} has two readings: other numbers of this sheet have decimal commas, so that the point may "
      "stand for a decimal point, {}, or for thousands, {}; write {} or {}",
      key, mill::quoted(value), mill::quoted(two[0]), mill::quoted(two[1]), mill::quoted(with_comma),
      mill::quoted(two[1]));
}

// Does some value of the sheet show that its decimals are written with a comma?
bool shows_decimal_commas(const std::vector<SheetRow> &rows)
{
  for (const SheetRow &row : rows)
    for (std::size_t i = 1; i < row.cells.size(); ++i)
      for (const std::string &part : split(row.cells[i], ";"))
        if (has_decimal_comma(stripped(part)))
          return true;
  return false;
}

void SheetReader::take(const SheetRow &row)
{
  const Place place{reading.file, row.line, 1};
  const std::string key = row.cells[0];
  if (row.cells.size() < 2 || row.cells[1].empty())
    return;  // a row of the form that was not filled in
  const Target target = target_of(key);
  if (!target.filled || !target.row)
    return reading.add(place, fmt::format("unknown key '{}'{}", shortened(key), near_key(key)));
  if (!seen.insert(key).second)
    return reading.add(place, fmt::format("'{}' appears twice; remove one of the two", key));
  const CellValues cells = values_of_row(*target.row, {row.cells.begin() + 1, row.cells.end()});
  if (cells.too_many)
    return reading.add(
        place, fmt::format("{}: {} cells in a row; key, value and unit are wanted", key, row.cells.size()));
  if (decimal_commas && target.row->kind != Kind::text)
    for (const std::string &value : cells.values)
      if (const auto two = readings_of_point(value); !two.empty())
        return reading.add(place, ambiguous_point(key, value, two));
  Node section;
  section.place = place;
  section.entries.push_back(
      {target.row->key, place, node_of_row(*target.row, cells.values, decimal_commas, place)});
  const auto last = key.rfind('.');
  if (read_row(*target.row, {&section, last == std::string::npos ? "" : key.substr(0, last)}, reading))
    set(*target.filled, target.row->key, toml_of_node(section.entries[0].value));
}
}  // namespace

std::string template_from_sheet(const std::string &kind, const std::string &file, const std::string &sheet)
{
  const auto &kinds = case_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError(fmt::format("no template is available for the kind '{}'{}", kind, suggestion(kind, kinds)));
  SheetReader reader(kind_named(kind), file);
  const auto rows       = rows_of_sheet(file, sheet);
  reader.decimal_commas = shows_decimal_commas(rows);
  for (const SheetRow &row : rows)
    reader.take(row);
  return reader.text();
}
}  // namespace mill
