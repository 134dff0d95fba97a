#pragma once
#include "core/base/csv_cells.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// A table in a text file, cell by cell with its place, for whoever reads one with words or units in it.
namespace mill::csv {
constexpr double largest_in_cell = 1e15;  ///< nothing a mill records reaches this in any unit

/// A cell with its place; the column is a number of characters.  Its text stays where it is in the file: a record
/// of 100 s has millions of cells.
struct Cell {
  std::string_view text;
  int line, column;
};

/// "force [kN]" taken apart.
struct Header {
  std::string name, unit;
  bool has_unit;
  int line, column;
};

/// A text file taken apart: header and rows of cells, blank and comment lines left out.
struct Sheet {
  std::string file;
  std::unique_ptr<const std::string> text;  ///< what the cells look into; on the heap, so that a sheet can move
  std::deque<std::string> unquoted;         ///< cells with doubled quotes, which stand so nowhere in the text
  std::vector<Header> header;
  std::vector<Cell> cells;  ///< row by row, as many in each as the header has
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
  template <class CellOrHeader> Place place(const CellOrHeader &cell) const
  {
    return {file, cell.line, cell.column};
  }
};

/// Separator comma, semicolon or tab, decimal comma with the latter two; quotes as in RFC 4180; byte-order mark,
/// UTF-16, Windows-1252, CRLF, blank lines and lines that begin with # are understood.
/// @param file     named in messages
/// @param example  of a header, shown when there is none
/// @throws InputError with file:line:column  empty, a line with another number of cells than the header, a quote
/// left
///         open
Sheet sheet_of(const std::string &file, std::string text, const std::string &example);

/// @throws InputError at the cell  empty, or no finite number
double number_of(const Cell &cell, const std::string &name, Sheet &sheet);

/// Column of this name.
/// @param sample  unit of the column, shown when it is missing; empty: it has none
/// @throws InputError at the header, with the names there are
std::size_t index_of(const Sheet &sheet, const std::string &name, const std::string &sample);

/// Unit of a column.
/// @param sample  names the wanted dimension and is shown as the example
/// @throws InputError at the header  no unit, an unknown one, another dimension
const Unit &unit_of(const Sheet &sheet, const Header &header, const std::string &sample);
}  // namespace mill::csv
