#include "twin/records/csv_columns.h"
#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace mill::twin {
namespace {
using Kind = CsvColumns::Kind;

// First reading of a number that may be written in several ways: its sign and order are the same in all.
double any_reading(const std::string_view cell, const StyleMask styles)
{
  double number = 0;
  for (std::size_t i = 0; i < number_styles.size(); ++i)
    if (styles >> i & 1 && read_number(cell, number_styles[i], number))
      return number;
  return number;
}

bool is_date_name(const std::string &name)
{
  static const std::set<std::string> names{"date", "datum"};
  return names.count(lower(name)) > 0;
}

void find_time(CsvColumns &columns, const CsvLayout &layout, const std::vector<ColumnEvidence> &evidence)
{
  std::vector<TimeEvidence> candidates;
  int date = -1;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const ColumnHead &head    = layout.columns[i].head;
    const ColumnEvidence &one = evidence[i];
    const bool texts          = one.times > 0 && one.numbers == 0 && one.texts == 0;
    if (is_date_name(head.name) && texts)
      date = int(i);
    else
      candidates.push_back({head.name, head.unit, texts, one.numbers > 0 && one.moves && !one.goes_back});
    if (date == int(i))
      candidates.push_back({});
  }
  int time = time_column_among(candidates);
  if (time >= 0 && !candidates[std::size_t(time)].is_text)
    date = -1;  // numbers of seconds have no use for a date
  if (time < 0)
    std::swap(time, date);  // "Date" holds day and time of day
  if (time >= 0)
    columns.kind[std::size_t(time)] = Kind::time;
  if (date >= 0)
    columns.kind[std::size_t(date)] = Kind::date;
}

void find_others(CsvColumns &columns, const CsvLayout &layout, const std::vector<ColumnEvidence> &evidence)
{
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const ColumnEvidence &one = evidence[i];
    const ColumnHead &head    = layout.columns[i].head;
    if (columns.kind[i] != Kind::channel)
      continue;
    const bool measures = unit_of_column(head.unit, "").known;
    if (head.name.empty()) {
      columns.kind[i] = Kind::ignored;
      if (one.numbers + one.texts + one.times > 0)
        columns.notes.push_back(fmt::format("column {} has no name and was not used", i + 1));
    } else if (one.times > 0 && one.numbers + one.texts == 0) {
      columns.kind[i] = Kind::ignored;
      columns.notes.push_back(fmt::format("column '{}' holds times too and was not used", head.name));
    } else if (one.texts > 0 && !measures)
      columns.kind[i] = Kind::label;
  }
}

void find_styles(CsvColumns &columns, const CsvLayout &layout, const std::vector<ColumnEvidence> &evidence)
{
  std::vector<StyleMask> all;
  for (std::size_t i = 0; i < evidence.size(); ++i)
    all.push_back(evidence[i].numbers > 0 && columns.kind[i] != Kind::label ? evidence[i].styles : every_style);
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (all[i] == 0)
      throw InputError(layout.columns[i].place,
                       fmt::format("the numbers of column '{}' are written in two ways: '.' or ',' separates "
                                   "thousands in one cell and decimals in another; export it in one way",
                                   layout.columns[i].head.name));
    const StyleChoice choice = style_of_column(all[i], all, layout.separator);
    columns.style.push_back(choice);
    if (choice.guessed)
      columns.notes.push_back(fmt::format(
          "column '{}': the comma was read as {}, because no cell of the file shows which of the two it is",
          layout.columns[i].head.name,
          choice.style.decimal == ',' ? "a decimal comma" : "a separator of thousands"));
    else if (choice.style.group != 0)
      columns.notes.push_back(fmt::format("column '{}': '{}' was read as separator of thousands",
                                          layout.columns[i].head.name, choice.style.group));
  }
}
}  // namespace

void CsvEvidence::add(const std::vector<std::string_view> &cells)
{
  for (std::size_t i = 0; i < std::min(cells.size(), columns_.size()); ++i) {
    ColumnEvidence &one    = columns_[i];
    const StyleMask styles = styles_of(cells[i]);
    if (styles == 0) {
      const CellKind kind = kind_of_cell(cells[i]);
      one.missing += kind == CellKind::missing;
      one.times += kind == CellKind::time;
      one.texts += kind == CellKind::text;
      continue;
    }
    one.styles &= styles;
    const double number = any_reading(cells[i], one.styles != 0 ? one.styles : styles);
    one.goes_back       = one.goes_back || (one.numbers > 0 && number < one.last);
    one.moves           = one.moves || (one.numbers > 0 && number != one.last);
    one.last            = number;
    ++one.numbers;
  }
}

int CsvColumns::find(const Kind wanted) const
{
  const auto first = std::find(kind.begin(), kind.end(), wanted);
  return first == kind.end() ? -1 : int(first - kind.begin());
}

bool operator==(const CsvColumns &a, const CsvColumns &b)
{
  return a.kind == b.kind && std::equal(a.style.begin(), a.style.end(), b.style.begin(), b.style.end(),
                                        [](const auto &x, const auto &y) { return x.style == y.style; });
}

CsvColumns columns_of(const CsvLayout &layout, const CsvEvidence &evidence)
{
  CsvColumns columns;
  columns.kind.assign(layout.columns.size(), Kind::channel);
  find_time(columns, layout, evidence.columns());
  find_others(columns, layout, evidence.columns());
  find_styles(columns, layout, evidence.columns());
  return columns;
}
}  // namespace mill::twin
