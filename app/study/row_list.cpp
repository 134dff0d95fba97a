#include "app/study/row_list.h"
#include "core/base/csv_sheet.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include <algorithm>

namespace mill {
namespace {
// A column of words: the number of a cell is the place of its word.
void read_words(const csv::Sheet &sheet, const std::size_t column, UncertainKey &key,
                std::vector<std::vector<double>> &rows)
{
  std::vector<std::string> &words = key.key.values;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::string word(sheet.cell(r, column).text);
    auto place = std::find(words.begin(), words.end(), word);
    if (place == words.end())
      place = words.insert(words.end(), word);
    rows[r].push_back(double(place - words.begin()));
  }
  key.key.numbers.assign(words.size(), not_given);
}

void read_numbers(csv::Sheet &sheet, const std::size_t column, const KnownKey &known, UncertainKey &key,
                  std::vector<std::vector<double>> &rows)
{
  const csv::Header header = sheet.header[column];
  if (known.row.kind == Kind::quantity || known.row.kind == Kind::pair)
    key.key.unit = csv::unit_of(sheet, header, known.row.form).symbol;
  for (std::size_t r = 0; r < rows.size(); ++r)
    rows[r].push_back(csv::number_of(sheet.cell(r, column), header.name, sheet));
}

KnownKey key_of_column(const Case &the_case, const std::vector<std::string> &sets, const csv::Sheet &sheet,
                       const csv::Header &header)
{
  try {
    return known_key(the_case, sets, header.name);
  } catch (const InputError &e) {
    throw InputError(sheet.place(header), e.problems.front().message);
  }
}
}  // namespace

RowList read_row_list(const Case &the_case, const std::vector<std::string> &sets, const std::string &path)
{
  if (path.empty())
    throw InputError(
        "--method list needs --list FILE.csv, whose header names keys with units: backup_roll.crown [um]");
  csv::Sheet sheet = csv::sheet_of(path, read_text(path), "backup_roll.crown [um],strip.friction");
  RowList list;
  list.rows.resize(sheet.n_rows());
  if (list.rows.empty())
    throw InputError(Place{path, 1, 1}, "the list has no rows");
  for (std::size_t r = 0; r < list.rows.size(); ++r)
    list.places.push_back(sheet.place(sheet.cell(r, 0)));
  std::vector<std::string> names;
  for (std::size_t column = 0; column < sheet.header.size(); ++column) {
    const KnownKey known = key_of_column(the_case, sets, sheet, sheet.header[column]);
    UncertainKey key{
        {known.name, known.path, known.row.meaning, "", {}, {}, known.row.kind == Kind::pair}, {}, "list"};
    if (known.row.kind == Kind::quantity || known.row.kind == Kind::number || known.row.kind == Kind::count ||
        known.row.kind == Kind::pair)
      read_numbers(sheet, column, known, key, list.rows);
    else
      read_words(sheet, column, key, list.rows);
    list.keys.push_back(key);
    names.push_back(known.name);
  }
  require_different_keys(names);
  return list;
}
}  // namespace mill
