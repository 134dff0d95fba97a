#pragma once
#include "twin/records/csv_columns.h"
#include "twin/records/record_clock.h"
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mill::twin {
/// Lines of a CSV record one by one: which columns hold channels, which one the time, and what a line holds.
class CsvRows {
public:
  static constexpr std::size_t lines_looked_at = 60;

  /// @param head     the first lines of the file, up to `lines_looked_at`, with one row of numbers at least
  /// @param options  lives as long as this
  /// @param whole    what all rows of the file say; nullptr: the head alone decides what the columns are
  /// @throws InputError as layout_of(); no time column and no rate, one without a unit
  CsvRows(std::string file, const std::vector<std::string> &head, const ReadOptions &options,
          const CsvEvidence *whole = nullptr);

  enum class Kind { samples, nothing, cut_off };
  /// @param last  the file ends behind this line without a line end: fewer cells are a line that is cut off
  /// @throws InputError with file:line:column  a wrong number of cells, a cell that is neither a number nor a time
  Kind take(std::string_view line, int number, bool last);

  /// Of the last line with samples.
  const std::vector<double> &values() const  ///< (channels) NaN where the cell is empty
  {
    return values_;
  }
  /// Of the last line with samples, (label columns); the views hold until the next line.
  const std::vector<std::string_view> &labels() const
  {
    return labels_;
  }
  double seconds() const  ///< s from the first line; only when timed()
  {
    return seconds_;
  }
  Place time_place(std::string_view line, int number) const;  ///< of the time in that line

  /// @throws InputError at the time of that line  it is before the one of the sample before, both in s
  void require_not_before(double earlier, double time, std::string_view line, int number) const;

  bool timed() const  ///< false: the rate was given
  {
    return time_ >= 0;
  }
  const CsvLayout &layout() const
  {
    return layout_;
  }
  const std::vector<std::size_t> &columns() const  ///< (channels) index into layout().columns
  {
    return columns_;
  }
  const std::vector<std::size_t> &label_columns() const  ///< index into layout().columns
  {
    return label_columns_;
  }
  const CsvColumns &decided() const  ///< what each column is read as
  {
    return decided_;
  }
  /// Adds a line to the evidence, as far as it has the columns of the layout.
  void look_at(std::string_view line, CsvEvidence &evidence);
  const RecordClock &clock() const
  {
    return clock_;
  }
  const std::vector<std::string> &notes() const
  {
    return notes_;
  }
  bool had_comma() const;  ///< the decimals of some column are written with a comma
  int blank_lines() const
  {
    return blank_lines_;
  }
  const Place &time_column() const
  {
    return time_column_;
  }

private:
  void share_columns();
  [[noreturn]] void refuse_timeless() const;
  void prepare_clock(const std::vector<std::string> &head);
  void cut(std::string_view line);
  void take_time(std::string_view line, int number);
  double value_of(std::string_view line, std::size_t column, int number);
  Place place(std::string_view line, std::size_t column, int number) const;

  std::string file_;
  const ReadOptions &options_;
  RecordClock clock_;
  CsvLayout layout_;
  CsvColumns decided_;
  int time_ = -1, date_ = -1;  // index of a column; date: of the day alone, next to a time of day
  double per_unit_ = 0;        // s per number of the time column; 0: texts
  bool texts_      = false;
  Place time_column_;
  std::vector<int> channel_of_column_;  // -1: none
  std::vector<std::size_t> columns_, label_columns_;
  std::vector<std::string> notes_;
  std::vector<std::string_view> labels_;
  std::vector<double> values_;
  double seconds_  = 0;
  int blank_lines_ = 0;
  std::deque<std::string> unquoted_;
  std::vector<std::string_view> cells_;
};

/// What all rows of a file say; nothing where they say the same of the columns as the first ones did.
/// @throws InputError  the file cannot be read any more
std::optional<CsvEvidence> evidence_of_all_rows(const std::string &path, CsvRows &rows);
}  // namespace mill::twin
