#include "core/case/bearing_catalogue.h"
#include "core/base/csv_sheet.h"
#include "core/case/embedded.h"
#include "core/case/fields.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mill {
namespace {
constexpr const char *header_example = "designation, type, d [mm], D [mm], B [mm], rows, C [kN], C0 [kN], source";

// Letters and digits in capitals: what a designation is compared by.
std::string plain_designation(const std::string &text)
{
  std::string out;
  for (const unsigned char c : text)
    if (std::isalnum(c) || c >= 0x80)
      out += char(std::toupper(c));
  return out;
}

std::string first_part(const std::string &designation)
{
  return plain_designation(designation.substr(0, designation.find('/')));
}

/// Reads the lines of one sheet; problems are gathered, so that a table is mended in one go.
class CatalogueReader {
public:
  explicit CatalogueReader(csv::Sheet &sheet_) : sheet(sheet_) {}

  std::vector<CatalogueBearing> all()
  {
    std::vector<CatalogueBearing> out;
    if (read_header())
      for (std::size_t row = 0; row < sheet.n_rows(); ++row)
        out.push_back(line(row));
    refuse_twins(out);
    if (!problems.empty())
      throw InputError(std::move(problems));
    return out;
  }

private:
  csv::Sheet &sheet;
  std::vector<Problem> problems;
  std::map<std::string, std::size_t> place;  // of the columns
  std::map<std::string, const Unit *> unit_of_column;

  template <class F> bool gathered(const F &read)
  {
    try {
      read();
      return true;
    } catch (const InputError &error) {
      problems.insert(problems.end(), error.problems.begin(), error.problems.end());
      return false;
    }
  }

  bool read_header()
  {
    const std::vector<std::pair<const char *, const char *>> columns{
        {"designation", ""}, {"type", ""}, {"d", "mm"},  {"D", "mm"},    {"B", "mm"},
        {"rows", ""},        {"C", "kN"},  {"C0", "kN"}, {"source", ""}, {"e", ""}};
    for (std::size_t i = 0; i < sheet.header.size(); ++i) {
      const csv::Header &header = sheet.header[i];
      const auto known          = std::find_if(columns.begin(), columns.end(),
                                               [&](const auto &column) { return header.name == column.first; });
      if (known == columns.end())
        problems.push_back(
            {sheet.place(header),
             fmt::format("column '{}' is unknown; a catalogue has {}, and e", header.name, header_example),
             {}});
      else if (!place.emplace(header.name, i).second)
        problems.push_back({sheet.place(header),
                            fmt::format("column '{}' stands twice", header.name),
                            {sheet.place(sheet.header[place[header.name]])}});
    }
    for (const auto &[name, unit] : columns)
      gathered([&, key = std::string(name), sample = std::string(unit)] {
        if (key == "e" && !place.count(key))
          return;
        const std::size_t i = csv::index_of(sheet, key, sample);
        if (!sample.empty())
          unit_of_column[key] = &csv::unit_of(sheet, sheet.header[i], sample);
        else if (sheet.header[i].has_unit && !sheet.header[i].unit.empty())
          throw InputError(sheet.place(sheet.header[i]),
                           fmt::format("column '{}' has the unit '{}'; it has none", key, sheet.header[i].unit));
      });
    return problems.empty();
  }

  const csv::Cell &cell(const std::size_t row, const std::string &column) const
  {
    return sheet.cell(row, place.at(column));
  }

  void refuse(const csv::Cell &where, const std::string &message)
  {
    problems.push_back({sheet.place(where), message, {}});
  }

  std::string word(const std::size_t row, const std::string &column, const char *what)
  {
    const csv::Cell &source = cell(row, column);
    if (source.text.empty())
      refuse(source, fmt::format("the cell of column '{}' is empty; {}", column, what));
    return std::string(source.text);
  }

  // In SI; NaN for an empty cell that may be empty.
  double number(const std::size_t row, const std::string &column, const double least, const double most,
                const bool may_be_empty = false)
  {
    const csv::Cell &source = cell(row, column);
    const auto unit         = unit_of_column.find(column);
    if (may_be_empty && source.text.empty())
      return not_given;
    double value = not_given;
    gathered([&] {
      const double read = csv::number_of(source, column, sheet);
      value             = unit == unit_of_column.end() ? read : to_si(read, *unit->second);
    });
    if (value < least || value > most) {
      const std::string form = unit == unit_of_column.end() ? "1" : unit->second->symbol;
      const auto in          = [&](const double si) {
        return unit == unit_of_column.end() ? si : from_si(si, *unit->second);
      };
      refuse(source,
             fmt::format("{} = {} is outside {}", column, source.text, range_in({in(least), in(most)}, form)));
      return not_given;
    }
    return value;
  }

  std::optional<BearingType> type_of(const std::size_t row)
  {
    std::vector<std::string> words;
    for (const BearingType type : {BearingType::four_row_tapered, BearingType::four_row_cylindrical})
      words.push_back(word_of(type));
    const std::string needed = fmt::format("one of {} is needed", fmt::join(words, " | "));
    const std::string text   = word(row, "type", needed.c_str());
    const auto type          = choice_named<BearingType>(text);
    if (type && *type != BearingType::oil_film)
      return type;
    if (!text.empty())
      refuse(cell(row, "type"), fmt::format("type '{}' is unknown{}", text, suggestion(text, words)));
    return std::nullopt;
  }

  CatalogueBearing line(const std::size_t row)
  {
    CatalogueBearing b;
    b.designation      = word(row, "designation", "a line without a designation cannot be looked up");
    b.place            = sheet.place(cell(row, "designation"));
    b.type             = type_of(row);
    b.source           = word(row, "source", "say where the figures of this line come from");
    b.bore             = number(row, "d", 0.02, 2.5);
    b.outside_diameter = number(row, "D", 0.03, 3.5);
    b.width            = number(row, "B", 0.005, 3);
    const double rows  = number(row, "rows", 1, 8);
    b.dynamic_rating   = number(row, "C", 1e3, 1e9, true);
    b.static_rating    = number(row, "C0", 1e3, 1e9, true);
    b.e                = place.count("e") ? number(row, "e", 0.01, 2.6, true) : not_given;
    b.rows             = std::isfinite(rows) ? int(rows) : 0;
    if (std::isfinite(rows) && rows != std::floor(rows))
      refuse(cell(row, "rows"), fmt::format("rows = {} is not a whole number", cell(row, "rows").text));
    if (b.outside_diameter <= b.bore)
      refuse(cell(row, "D"), fmt::format("the outside diameter {} is not larger than the bore {}",
                                         cell(row, "D").text, cell(row, "d").text));
    if (std::isfinite(b.dynamic_rating) != std::isfinite(b.static_rating))
      refuse(cell(row, std::isfinite(b.dynamic_rating) ? "C0" : "C"),
             "one of the ratings C and C0 is missing; give both or neither");
    return b;
  }

  void refuse_twins(const std::vector<CatalogueBearing> &bearings)
  {
    std::map<std::string, const CatalogueBearing *> seen;
    for (const CatalogueBearing &b : bearings)
      if (const auto [it, first] = seen.emplace(plain_designation(b.designation), &b);
          !first && !b.designation.empty())
        problems.push_back(
            {b.place,
             fmt::format("designation '{}' appears twice; keep one of the two lines", b.designation),
             {it->second->place}});
  }
};
}  // namespace

std::vector<CatalogueBearing> catalogue_of(const std::string &file, const std::string &text)
{
  csv::Sheet sheet = csv::sheet_of(file, text, header_example);
  return CatalogueReader(sheet).all();
}

const std::vector<CatalogueBearing> &shipped_catalogue()
{
  static const auto catalogue = catalogue_of("core/case/bearings.csv", embedded::bearings_csv);
  return catalogue;
}

const CatalogueBearing *find_bearing(const std::vector<CatalogueBearing> &catalogue,
                                     const std::string &designation)
{
  const std::string wanted        = plain_designation(designation);
  const CatalogueBearing *by_part = nullptr;
  bool several                    = false;
  for (const CatalogueBearing &b : catalogue) {
    if (plain_designation(b.designation) == wanted)
      return &b;
    if (first_part(b.designation) == wanted) {
      several = several || by_part;
      by_part = &b;
    }
  }
  return several || wanted.empty() ? nullptr : by_part;
}

std::vector<std::string> nearest_designations(const std::vector<CatalogueBearing> &catalogue,
                                              const std::string &designation, const std::size_t most)
{
  const std::string wanted = plain_designation(designation).substr(0, 60);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const CatalogueBearing &b : catalogue)
    near.emplace_back(std::min(slips_between(wanted, plain_designation(b.designation)),
                               slips_between(wanted, first_part(b.designation))),
                      b.designation);
  std::stable_sort(near.begin(), near.end(), [](const auto &x, const auto &y) { return x.first < y.first; });
  std::vector<std::string> out;
  for (std::size_t i = 0; i < std::min(most, near.size()); ++i)
    out.push_back(near[i].second);
  return out;
}
}  // namespace mill
