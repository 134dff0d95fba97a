#pragma once
#include "twin/records/csv_layout.h"
#include "twin/records/number_style.h"
#include <string>
#include <string_view>
#include <vector>

namespace mill::twin {
/// What the cells of one column say together.
struct ColumnEvidence {
  StyleMask styles = every_style;  ///< in which each of its numbers is one
  long numbers = 0, texts = 0, times = 0, missing = 0;
  bool goes_back = false, moves = false;  ///< of its numbers, one after the other
  double last = 0;                        ///< of them
};

/// What the cells of a CSV file say, row by row; from the first rows or from all.
class CsvEvidence {
public:
  explicit CsvEvidence(const std::size_t n_columns) : columns_(n_columns) {}
  void add(const std::vector<std::string_view> &cells);
  const std::vector<ColumnEvidence> &columns() const
  {
    return columns_;
  }

private:
  std::vector<ColumnEvidence> columns_;
};

/// What each column of a CSV file is read as.
struct CsvColumns {
  enum class Kind { channel, time, date, label, ignored };
  std::vector<Kind> kind;
  std::vector<StyleChoice> style;  ///< of numbers
  std::vector<std::string> notes;  ///< what is not used, and what was guessed
  int find(Kind wanted) const;     ///< index of the first column of a kind; -1: none
};
bool operator==(const CsvColumns &a, const CsvColumns &b);

/// @throws InputError  a column whose numbers are written in two ways
CsvColumns columns_of(const CsvLayout &layout, const CsvEvidence &evidence);
}  // namespace mill::twin
