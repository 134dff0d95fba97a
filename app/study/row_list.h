#pragma once
#include "app/study/spread.h"
#include "core/base/errors.h"
#include <string>
#include <vector>

namespace mill {
/// Rows that somebody listed.
struct RowList {
  std::vector<UncertainKey> keys;
  std::vector<std::vector<double>> rows;  ///< (rows, keys) as set_value() takes them
  std::vector<Place> places;              ///< (rows) of their first cells
};

/// Reads a CSV file whose header names keys with their units, "backup_roll.crown [um]"; words of a choice need
/// none.
/// @throws InputError with file:line:column  no rows, a key twice, unknown, or without its unit; a cell that is
/// not
///                    a number
RowList read_row_list(const Case &the_case, const std::vector<std::string> &sets, const std::string &path);
}  // namespace mill
