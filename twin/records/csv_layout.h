#pragma once
#include "twin/records/channel_names.h"
#include <deque>
#include <string>
#include <string_view>
#include <vector>

// Where in a CSV file of a plant, a spreadsheet or an oscilloscope the columns and the numbers are.
namespace mill::twin {
/// What is written before the first row of numbers.
struct CsvLayout {
  char separator = ',';
  struct Column {
    ColumnHead head;
    Place place;
  };
  std::vector<Column> columns;
  int first_data_line = 0;  ///< from 1
  std::vector<std::string> notes;
};

/// The cells of a line (core/base/csv_cells), faults of quotes passed over.  Views into the line or into
/// `unquoted`.
void split_cells(std::string_view line, char separator, std::deque<std::string> &unquoted,
                 std::vector<std::string_view> &cells);

/// Column, counted in characters from 1, at which a cell of a line begins.
int column_of(std::string_view line, std::string_view cell, std::size_t index, char separator);

/// Is it what recorders write where there is no value: empty, NaN, null, n/a, -, ..
bool is_missing(std::string_view cell);

/// What one cell holds.
enum class CellKind { missing, number, time, text };
CellKind kind_of_cell(std::string_view cell);

/// Looks at the first lines of a file, which are valid UTF-8.
/// @param lines  the first ones, numbered from 1
/// @throws InputError  no row of numbers among them, none that names the columns
CsvLayout layout_of(const std::string &file, const std::vector<std::string> &lines);
}  // namespace mill::twin
