#include "live/source/csv_feed.h"
#include "core/case/errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr std::size_t rows_for_rate = 4096;
constexpr double block_length       = 0.02;  // s
constexpr int bad_lines_of_a_file   = 5;

// The number with the fewest digits within the tolerance; `digits` tells how many.
double fewest_digits(const double value, const double tolerance, int &digits)
{
  for (digits = 1; digits < 12; ++digits) {
    const double scale   = std::pow(10, digits - 1 - std::floor(std::log10(value)));
    const double rounded = std::round(value * scale) / scale;
    if (std::abs(rounded / value - 1) <= tolerance)
      return rounded;
  }
  return value;
}
}  // namespace

double rate_of_times(const std::vector<double> &t)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i)
    steps.push_back(t[i] - t[i - 1]);
  if (steps.empty())
    throw InputError("one line is not enough to tell the samples per second; give --rate 20000");
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  const double step = steps[steps.size() / 2];
  if (!(step > 0))
    throw InputError(
        "half of the times stand still: the time column is too coarse, give the samples per second with "
        "--rate 20000");
  double k = 0;
  std::vector<double> counter{0};
  for (std::size_t i = 1; i < t.size(); ++i)
    counter.push_back(k += std::round((t[i] - t[i - 1]) / step));
  // least squares through the counter
  const double n = double(t.size());
  double mk = 0, mt = 0, kk = 0, kt = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    mk += counter[i] / n;
    mt += t[i] / n;
  }
  for (std::size_t i = 0; i < t.size(); ++i) {
    kk += (counter[i] - mk) * (counter[i] - mk);
    kt += (counter[i] - mk) * (t[i] - mt);
  }
  const double slope = kt / kk;
  double residual    = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    residual = std::max(residual, std::abs(t[i] - mt - slope * (counter[i] - mk)));
  const double tolerance = 1e-10 + 2 * residual / (t.back() - t.front());
  int of_rate = 0, of_step = 0;
  const double by_rate = fewest_digits(1 / slope, tolerance, of_rate);
  const double by_step = 1 / fewest_digits(slope, tolerance, of_step);
  return of_step < of_rate ? by_step : by_rate;
}

CsvFeed::CsvFeed(std::string name, SourceRules rules) : name_(std::move(name)), rules_(std::move(rules)) {}

std::vector<Message> CsvFeed::take()
{
  return std::exchange(ready_, {});
}

void CsvFeed::refuse(const std::string &reason)
{
  ready_.push_back(RefusedLine{reason, 0, 0});
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
  if (!rows_) {
    first_lines_.emplace_back(text);
    if (first_lines_.size() >= twin::CsvRows::lines_looked_at)
      make_rows();
    return;
  }
  if (new_file_ && head_line_ < head_lines_.size()) {  // a head that is said again, or none
    if (text == head_lines_[head_line_]) {
      ++head_line_;
      return;
    }
    new_file_ = false;
  }
  row(text, number);
}

void CsvFeed::make_rows()
{
  rows_.emplace(name_, first_lines_, rules_.reading);
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
  for (const std::string &note : rows_->notes())
    ready_.push_back(SourceNote{"note", note});
  head.source = name_;
  head_       = head;
  head_->rate = 0;
  if (!rows_->timed())
    make_head();
  const auto lines = std::exchange(first_lines_, {});
  for (std::size_t i = first; i < lines.size(); ++i)
    row(lines[i], int(i) + 1);
}

void CsvFeed::make_head()
{
  if (rows_->timed()) {
    try {
      head_->rate = rate_of_times(early_seconds_);
    } catch (const InputError &error) {
      throw InputError(rows_->time_column(), error.problems.front().message);
    }
    head_->start = rows_->clock().start();
  } else
    head_->rate = *rules_.reading.rate;
  ready_.push_back(*head_);
  const auto seconds = std::exchange(early_seconds_, {});
  const auto values  = std::exchange(early_values_, {});
  for (std::size_t i = 0; i < seconds.size(); ++i)
    add(seconds[i], values[i]);
}

void CsvFeed::row(const std::string_view text, const int number)
{
  try {
    if (rows_->take(text, number, false) != twin::CsvRows::Kind::samples)
      return;
  } catch (const InputError &error) {
    const Problem &problem = error.problems.front();
    refuse(fmt::format("{}:{}:{}: {}", problem.place.file, problem.place.line, problem.place.column,
                       problem.message));
    return;
  }
  bad_in_a_row_ = 0;
  if (head_->rate > 0) {
    add(rows_->seconds(), rows_->values());
    return;
  }
  early_seconds_.push_back(rows_->seconds());
  early_values_.push_back(rows_->values());
  if (early_seconds_.size() >= rows_for_rate)
    make_head();
}

void CsvFeed::add(const double seconds, const std::vector<double> &values)
{
  const std::int64_t s = rows_->timed() ? std::llround(seconds * head_->rate) : next_;
  if (s < next_ - 1 && !said_back_) {
    said_back_ = true;
    ready_.push_back(SourceNote{
        "loss", fmt::format("{}: the time goes back by {:.4g} s; what stands there a second time is not used",
                            name_, double(next_ - s) / head_->rate)});
  }
  next_ = std::max(next_, s + 1);
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
  if (!rows_ && !first_lines_.empty())
    make_rows();
  if (rows_ && !(head_->rate > 0) && early_seconds_.size() >= 2)
    make_head();
  if (rows_ && head_->rate > 0)
    emit();
}

void CsvFeed::new_file()
{
  new_file_  = true;
  head_line_ = 0;
}
}  // namespace mill::live
