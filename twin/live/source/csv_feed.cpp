#include "twin/live/source/csv_feed.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr std::size_t rows_for_rate = 4096;
constexpr double block_length       = 0.02;  // s
constexpr int bad_lines_of_a_file   = 5;
constexpr double largest_number     = 9e15;  // of a sample, below 2^53
}  // namespace

CsvFeed::CsvFeed(std::string name, SourceRules rules) : name_(std::move(name)), rules_(std::move(rules)) {}

std::vector<Message> CsvFeed::take()
{
  return std::exchange(ready_, {});
}

void CsvFeed::refuse(const std::string &reason, const std::int64_t first, const std::int64_t n)
{
  ready_.push_back(RefusedLine{reason, first, n});
  if (++bad_in_a_row_ >= bad_lines_of_a_file && rules_.closes && !closed_) {
    settle();
    closed_ = true;
    ready_.push_back(SourceEnd{name_ + ": five bad lines in a row; the source was closed"});
  }
}

void CsvFeed::line(const std::string_view text, const int number)
{
  if (closed_)
    return;
  if (text.size() > line_limits.bytes) {
    refuse(fmt::format("{}:{}: longer than 1 MiB", name_, number));
    return;
  }
  if (rows_) {
    row(text, number);
    return;
  }
  if (first_lines_.empty())
    first_number_ = number;
  first_lines_.emplace_back(text);
  if (first_lines_.size() >= twin::CsvRows::lines_looked_at)
    make_rows();
}

void CsvFeed::make_rows()
{
  const int lines_before = first_number_ - 1;
  try {
    rows_.emplace(name_, first_lines_, rules_.reading);
    make_channels();
  } catch (const InputError &error) {
    Problem problem = error.problems.front();
    if (problem.place.line > 0)
      problem.place.line += lines_before;
    throw InputError(problem.place, problem.message);
  }
  for (const std::string &note : rows_->notes())
    ready_.push_back(SourceNote{"note", note});
  if (!rows_->timed())
    make_head();
  const auto lines = std::exchange(first_lines_, {});
  for (std::size_t i = head_lines_.size(); i < lines.size(); ++i)
    line(lines[i], lines_before + int(i) + 1);  // among them may be another head
}

void CsvFeed::make_channels()
{
  const auto first = std::size_t(rows_->layout().first_data_line - 1);
  head_lines_.assign(first_lines_.begin(), first_lines_.begin() + std::ptrdiff_t(first));
  std::vector<NamedUnit> sent;
  for (const std::size_t column : rows_->columns()) {
    const twin::ColumnHead &head = rows_->layout().columns[column].head;
    sent.push_back({head.name, head.unit});
  }
  SourceHead head;
  try {
    auto known    = known_channels(sent, rules_);
    head.channels = std::move(known.channels);
    head.factor   = std::move(known.factor);
  } catch (const InputError &error) {
    throw InputError(rows_->layout().columns.front().place, error.problems.front().message);
  }
  head.source = name_;
  head_       = head;
  head_->rate = 0;
}

void CsvFeed::make_head()
{
  if (rows_->timed()) {
    std::vector<double> seconds;
    for (const TimedRow &row : early_)
      seconds.push_back(row.seconds);
    try {
      head_->rate = rate_of_times(seconds);
    } catch (const InputError &error) {
      throw InputError(rows_->time_column(), error.problems.front().message);
    }
    head_->start = rows_->clock().start();
  } else
    head_->rate = *rules_.reading.rate;
  if (const auto from = std::exchange(resumed_, {}))
    take_up(*from);
  ready_.push_back(*head_);
  for (const TimedRow &row : std::exchange(early_, {}))
    take_time(row.seconds, row.values, row.number);
}

// The numbers of a file begin at its first row, those of before the restart elsewhere.  Of another rate the rows
// are another source with numbers of its own.
void CsvFeed::take_up(const ResumedFile &from)
{
  const double same = head_->rate / from.rate;  // of numbers
  if (head_->start && from.start) {
    skip_to_ = std::llround((*from.start - *head_->start) * head_->rate + double(from.next) * same);
    return;
  }
  const std::int64_t first = from.other ? from.next : from.first;
  if (from.other)
    ready_.push_back(SourceNote{
        "loss", name_ +
                    ": another file than before the restart, and its times have no date: taken to go on behind "
                    "the sample before; what was lost between them is not known"});
  if (same != 1) {
    skip_to_ = std::llround(double(from.next - first) * same);
    return;
  }
  skip_to_ = from.next;
  if (rows_->timed())
    shift_ = double(first) / head_->rate;
  else
    next_ = first;
}

void CsvFeed::row(const std::string_view text, const int number)
{
  try {
    if (rows_->take(text, number, false) != twin::CsvRows::Kind::samples)
      return;
  } catch (const InputError &error) {
    bad_row(text, number, error.problems.front());
    return;
  }
  bad_in_a_row_ = 0;
  if (!rows_->timed()) {
    add(next_, rows_->values());
    return;
  }
  if (head_->rate > 0) {
    take_time(rows_->seconds(), rows_->values(), number);
    return;
  }
  early_.push_back({rows_->seconds(), rows_->values(), number});
  if (early_.size() >= rows_for_rate)
    make_head();
}

// No row: the head said again, another head, or a line that is refused.
void CsvFeed::bad_row(const std::string_view text, const int number, const Problem &problem)
{
  if (std::find(head_lines_.begin(), head_lines_.end(), text) != head_lines_.end())
    return;
  if (is_other_head(text)) {
    begin_again(text, number);
    return;
  }
  const std::string reason =
      fmt::format("{}:{}:{}: {}", problem.place.file, problem.place.line, problem.place.column, problem.message);
  if (rows_->timed()) {  // its sample shows as missing when the next line comes
    refuse(reason);
    return;
  }
  emit();  // a line is a sample where no time says otherwise
  refuse(reason, next_, 1);
  ++next_;
}

// Names alone, one of them that of a column there was before.
bool CsvFeed::is_other_head(const std::string_view text) const
{
  if (head_lines_.empty())
    return false;
  const char separator = rows_->layout().separator;
  std::deque<std::string> unquoted;
  std::vector<std::string_view> cells, before;
  twin::split_cells(text, separator, unquoted, cells);
  for (const std::string &line : head_lines_) {
    std::vector<std::string_view> more;
    twin::split_cells(line, separator, unquoted, more);
    before.insert(before.end(), more.begin(), more.end());
  }
  bool known = false;
  for (const std::string_view cell : cells) {
    const auto letter = cell.empty() ? '\0' : cell.front();
    if (!std::isalpha(static_cast<unsigned char>(letter)) && static_cast<unsigned char>(letter) < 0x80)
      return false;
    known = known || std::find(before.begin(), before.end(), cell) != before.end();
  }
  return known && cells.size() > 1;
}

void CsvFeed::begin_again(const std::string_view head, const int number)
{
  refuse_held();
  settle();
  ready_.push_back(SourceNote{
      "note", fmt::format("{}:{}: other columns from here on; it is read as a new record", name_, number)});
  rows_.reset();
  head_.reset();
  early_.clear();
  times_.restart();
  next_ = skip_to_ = 0;
  shift_           = 0;
  resumed_.reset();
  first_of_file_.reset();
  first_number_ = number;
  first_lines_.assign(1, std::string(head));
}

// A time that jumps is believed when the next line follows it; alone, it is refused.
void CsvFeed::take_time(const double seconds, const std::vector<double> &values, const int number)
{
  if (held_ && !RowTimes::follows(held_->seconds, seconds, head_->rate))
    refuse_held();
  if (closed_)
    return;
  if (const auto held = std::exchange(held_, {})) {
    say_jump(*held);
    believe(*held);
  }
  if (!(std::abs(seconds + shift_) * head_->rate < largest_number)) {
    refuse(fmt::format("{}:{}: the time is beyond what samples can be numbered to", name_, number));
    return;
  }
  const TimedRow row{seconds, values, number};
  const bool begins_again = new_file_ && !head_->start && times_.last() && seconds + shift_ < *times_.last();
  new_file_               = false;
  if (begins_again)
    go_on_from(row);
  else if (times_.jump(seconds + shift_, head_->rate)) {
    held_ = row;
    return;
  }
  believe(row);
}

void CsvFeed::refuse_held()
{
  if (!held_)
    return;
  const double away = times_.jump(held_->seconds + shift_, head_->rate).value_or(0);
  refuse(
      fmt::format("{}:{}: the time is {:.6g} s {} that of the line before, and the next line does not follow it",
                  name_, held_->number, std::abs(away), away > 0 ? "ahead of" : "behind"));
  held_.reset();
}

void CsvFeed::say_jump(const TimedRow &row)
{
  const double away = times_.jump(row.seconds + shift_, head_->rate).value_or(0);
  if (away < 0 && !head_->start) {
    go_on_from(row);
    return;
  }
  ready_.push_back(SourceNote{
      "loss", away > 0 ? fmt::format("{}:{}: the clock jumps ahead by {:.6g} s and goes on from there: what is "
                                     "between is missing",
                                     name_, row.number, away)
                       : fmt::format("{}:{}: the clock goes back by {:.6g} s: samples of the same time are "
                                     "not used",
                                     name_, row.number, -away)});
  said_back_ = said_back_ || away < 0;
}

// Of a clock without a date that begins again: only the order of the lines says when they were.
void CsvFeed::go_on_from(const TimedRow &row)
{
  const double away = row.seconds + shift_ - *times_.last() - 1 / head_->rate;
  shift_ -= away;
  ready_.push_back(SourceNote{
      "loss", fmt::format("{}:{}: the time goes back by {:.6g} s and has no date: taken to go on behind the line "
                          "before; what was lost between them is not known",
                          name_, row.number, -away)});
}

void CsvFeed::believe(const TimedRow &row)
{
  const double seconds = row.seconds + shift_;
  if (const auto rate = times_.take(seconds, head_->rate))
    change_rate(*rate, row.number);
  const std::int64_t s = std::llround(seconds * head_->rate);
  if (s < next_ - 1 && !said_back_)
    ready_.push_back(
        SourceNote{"loss", fmt::format("{}: the time goes back by {:.4g} s; samples of the same time are not used",
                                       name_, double(next_ - s) / head_->rate)});
  said_back_ = s < next_ - 1;
  add(s, row.values);
}

void CsvFeed::change_rate(const double rate, const int number)
{
  emit();
  ready_.push_back(SourceNote{
      "note", fmt::format("{}:{}: {:.6g} samples per second, {:.6g} before; the twin goes on with the new rate",
                          name_, number, rate, head_->rate)});
  next_       = std::llround(double(next_) * rate / head_->rate);
  skip_to_    = 0;
  head_->rate = rate;
  ready_.push_back(*head_);
}

void CsvFeed::add(const std::int64_t s, const std::vector<double> &values)
{
  next_ = std::max(next_, s + 1);
  if (!first_of_file_)
    first_of_file_ = s;
  if (s < skip_to_)
    return;
  if (block_rows_ > 0 && s != block_first_ + block_rows_)
    emit();
  if (block_rows_ == 0)
    block_first_ = s;
  for (std::size_t c = 0; c < values.size(); ++c)
    block_.push_back(values[c] * head_->factor[c]);
  ++block_rows_;
  if (double(block_rows_) >= block_length * head_->rate || std::size_t(block_rows_) == line_limits.samples)
    emit();
}

void CsvFeed::emit()
{
  if (block_rows_ == 0)
    return;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  SourceBlock block;
  block.first = block_first_;
  block.value = Eigen::Map<const RowMajor>(block_.data(), block_rows_, Eigen::Index(head_->factor.size()));
  ready_.push_back(std::move(block));
  block_.clear();
  block_rows_ = 0;
}

void CsvFeed::settle()
{
  if (closed_)
    return;
  const auto has_number = [](const std::string &line) {
    const auto first = line.find_first_not_of(" \t\"+-.");
    return first != std::string::npos && line[first] >= '0' && line[first] <= '9';
  };
  // A head of which no row has come yet is waited for.
  if (!rows_ && std::any_of(first_lines_.begin(), first_lines_.end(), has_number))
    make_rows();
  if (rows_ && !(head_->rate > 0) && early_.size() >= 2)
    make_head();
  if (rows_ && head_->rate > 0)
    emit();
}

void CsvFeed::finish()
{
  if (!closed_ && !rows_ && !first_lines_.empty())
    make_rows();
  refuse_held();
  settle();
}

void CsvFeed::new_file()
{
  settle();
  new_file_ = true;
  first_of_file_.reset();
}
}  // namespace mill::live
