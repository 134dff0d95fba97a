#pragma once
#include "app/study/row_model.h"
#include "app/study/varied_key.h"
#include <string>
#include <vector>

// The table of a sweep: what its folder holds and its page shows.
namespace mill {
/// One computed row.
struct TableRow {
  std::vector<std::string> values;  ///< of the varied keys, as --set takes them
  std::vector<double> numbers;      ///< the same in the unit of the key; NaN: a word
  std::vector<double> results;      ///< of the watched names, in their units; NaN where the row failed
  std::string failure;              ///< why there are no results; empty: there are
};

struct StudyTable {
  std::string case_name, case_path, title;
  std::string work;             ///< "closed forms", "stiffness": RowModel::work()
  std::vector<VariedKey> keys;  ///< their values are those of the axes
  NamedResults watched;         ///< of the base case: name, unit, error
  std::vector<TableRow> rows;
  double seconds = 0;  ///< s, wall clock of all rows
};

/// A name with its unit as the head of a column of a CSV file; hidden characters of the name are written out.
std::string column_head(const std::string &name, const std::string &unit);

/// results.csv: one line for each row; "row", the keys with their units, the watched results with theirs, and the
/// sentence of a failed row.
std::string table_csv(const StudyTable &table);

/// sweep.json, all of the table, from which the page is written.
std::string table_json(const StudyTable &table);
}  // namespace mill
