#pragma once
#include "core/base/errors.h"
#include "twin/live/source/line_session.h"
#include "twin/live/source/row_times.h"
#include "twin/records/csv_rows.h"
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mill::live {
/// Where a twin goes on after a restart, in the numbers that the source had before it.
struct ResumedFile {
  std::int64_t next = 0;        ///< of the next sample
  double rate       = 0;        ///< Hz
  std::optional<double> start;  ///< s since 1970 UTC, of sample 0; none: not known
  std::int64_t first = 0;       ///< of the first sample of the file that was read last
  bool other         = false;   ///< another file is read now
};

/// Lines of a CSV record that is played or that grows, to messages.  Nothing here reads a file.
class CsvFeed {
public:
  /// @param name  of the source
  CsvFeed(std::string name, SourceRules rules);

  /// One line without its end.  @throws InputError  no head can be made of the first lines
  void line(std::string_view text, int number);
  /// No more lines for now: what waits goes out, and the head is made of the rows there are.
  void settle();
  /// Lines of another file of the same recorder come next: its head may be said again, its times may begin again.
  void new_file();
  /// No more lines at all.
  void finish();
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
  /// Before the first line: rows that were processed before a restart are left out.  Dates say which these are;
  /// without dates a file that was read before goes on behind them, and another one begins behind them.
  void resume(const ResumedFile &from)
  {
    resumed_ = from;
  }
  /// Number of the first row since the last new_file(); nothing: none has come.
  const std::optional<std::int64_t> &first_of_file() const
  {
    return first_of_file_;
  }
  double rate() const
  {
    return head_ ? head_->rate : 0;
  }

private:
  struct TimedRow {
    double seconds;
    std::vector<double> values;
    int number;  // of its line
  };
  void make_rows();
  void make_channels();
  void make_head();
  void take_up(const ResumedFile &from);
  void row(std::string_view text, int number);
  void bad_row(std::string_view text, int number, const Problem &problem);
  bool is_other_head(std::string_view text) const;
  void begin_again(std::string_view head, int number);
  void take_time(double seconds, const std::vector<double> &values, int number);
  void refuse_held();
  void say_jump(const TimedRow &row);
  void go_on_from(const TimedRow &row);
  void believe(const TimedRow &row);
  void change_rate(double rate, int number);
  void add(std::int64_t s, const std::vector<double> &values);
  void emit();
  void refuse(const std::string &reason, std::int64_t first = 0, std::int64_t n = 0);

  std::string name_;
  SourceRules rules_;
  std::vector<std::string> first_lines_;
  std::vector<std::string> head_lines_;  // before the first row of numbers
  std::optional<twin::CsvRows> rows_;
  std::optional<SourceHead> head_;
  std::vector<TimedRow> early_;   // until the rate is known
  std::optional<TimedRow> held_;  // after a jump, until the next row follows it or does not
  RowTimes times_;
  double shift_ = 0;           // s, of a clock without a date that began again
  std::vector<double> block_;  // row by row
  std::int64_t block_first_ = 0, block_rows_ = 0, next_ = 0, skip_to_ = 0;
  std::optional<ResumedFile> resumed_;  // until the rate is known
  std::optional<std::int64_t> first_of_file_;
  std::vector<Message> ready_;
  int first_number_ = 1;  // line of first_lines_.front()
  int bad_in_a_row_ = 0;
  bool closed_ = false, said_back_ = false, new_file_ = false;
};
}  // namespace mill::live
