#pragma once
#include "live/source/line_session.h"
#include "twin/records/csv_rows.h"
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mill::live {
/// Samples per second of the times of some rows: the slope of the counter, rounded to the fewest digits that the
/// resolution of the times allows.  theory.md (48.9)
/// @param seconds  ascending but for slips, two at least
/// @throws InputError  half of the times stand still
double rate_of_times(const std::vector<double> &seconds);

/// Lines of a CSV record that is played or that grows, to messages.  Nothing here reads a file.
class CsvFeed {
public:
  /// @param name  of the source
  CsvFeed(std::string name, SourceRules rules);

  /// One line without its end.  @throws InputError  no head can be made of the first lines
  void line(std::string_view text, int number);
  /// No more lines for now: what waits goes out, and the head is made of the rows there are.
  void settle();
  /// Lines of another file of the same recorder come next.
  void new_file();
  /// Messages that are ready.
  std::vector<Message> take();
  bool has_head() const
  {
    return head_.has_value();
  }
  bool closed() const  ///< five bad lines in a row
  {
    return closed_;
  }
  /// Rows before this number are left out: they were processed before a restart.
  void skip_to(std::int64_t next)
  {
    skip_to_ = next;
  }
  double rate() const
  {
    return head_ ? head_->rate : 0;
  }

private:
  void make_rows();
  void make_head();
  void row(std::string_view text, int number);
  void add(double seconds, const std::vector<double> &values);
  void emit();
  void refuse(const std::string &reason);

  std::string name_;
  SourceRules rules_;
  std::vector<std::string> first_lines_;
  std::vector<std::string> head_lines_;  // before the first row of numbers
  std::optional<twin::CsvRows> rows_;
  std::optional<SourceHead> head_;
  std::vector<double> early_seconds_;
  std::vector<std::vector<double>> early_values_;  // until the rate is known
  std::vector<double> block_;                      // row by row
  std::int64_t block_first_ = 0, block_rows_ = 0, next_ = 0, skip_to_ = 0;
  std::vector<Message> ready_;
  std::size_t head_line_ = 0;  // of a new file, that is expected to be said again
  int bad_in_a_row_      = 0;
  bool new_file_ = false, closed_ = false, said_back_ = false;
};
}  // namespace mill::live
