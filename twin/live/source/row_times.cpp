#include "twin/live/source/row_times.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::live {
namespace {
constexpr double most_still         = 0.01;  // share of times that are those of the row before
constexpr std::size_t rows_for_look = 256;
constexpr double another_rate       = 0.05;  // share of the rate
constexpr double longest_gap        = 1;     // s, within the rows of one look
constexpr double longest_next_step  = 3;     // samples, of a row that follows another

const char *const not_increasing = "the times do not increase; give the samples per second with --rate 20000";

double median(std::vector<double> values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

// s between rows `from` to `to`, of those that follow each other: a gap or a slip is none.
double mean_step(const std::vector<double> &t, const std::size_t from, const std::size_t to)
{
  std::vector<double> steps;
  for (std::size_t i = from + 1; i < to; ++i)
    steps.push_back(t[i] - t[i - 1]);
  const double usual = median(steps);
  double sum = 0, n = 0;
  for (const double step : steps)
    if (step > 0.5 * usual && step < 2 * usual) {
      sum += step;
      ++n;
    }
  return n > 0 ? sum / n : 0;
}

bool alike(const double a, const double b)
{
  return std::abs(a / b - 1) < another_rate;
}
}  // namespace

double rate_of_times(const std::vector<double> &t)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i)
    steps.push_back(t[i] - t[i - 1]);
  if (steps.empty())
    throw InputError("one line is not enough to tell the samples per second; give --rate 20000");
  const auto still = std::count(steps.begin(), steps.end(), 0.0);
  if (double(still) > most_still * double(steps.size()))
    throw InputError(fmt::format("{} of {} times stand still: the time column is too coarse, give the samples per "
                                 "second with --rate 20000",
                                 still, steps.size()));
  const double step = median(steps);
  if (!(step > 0))
    throw InputError(not_increasing);
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
  if (!(slope > 0) || !std::isfinite(1 / slope))
    throw InputError(not_increasing);
  double residual = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    residual = std::max(residual, std::abs(t[i] - mt - slope * (counter[i] - mk)));
  const double tolerance = 1e-10 + 2 * residual / (t.back() - t.front());
  int of_rate = 0, of_step = 0;
  const double by_rate = fewest_digits(1 / slope, tolerance, of_rate);
  const double by_step = 1 / fewest_digits(slope, tolerance, of_step);
  return of_step < of_rate ? by_step : by_rate;
}

std::optional<double> RowTimes::jump(const double seconds, const double rate) const
{
  if (!last_)
    return {};
  const double away = seconds - *last_ - 1 / rate;
  return away > longest_jump || away < -longest_return ? std::optional(away) : std::nullopt;
}

bool RowTimes::follows(const double before, const double seconds, const double rate)
{
  const double samples = (seconds - before) * rate;
  return samples > 0 && samples < longest_next_step;
}

std::optional<double> RowTimes::take(const double seconds, const double rate)
{
  if (last_ && (seconds < *last_ || seconds - *last_ > longest_gap))
    seconds_.clear();
  last_ = seconds;
  seconds_.push_back(seconds);
  if (seconds_.size() < rows_for_look)
    return {};
  const std::vector<double> looked_at = std::exchange(seconds_, {seconds});
  const double early                  = mean_step(looked_at, 0, rows_for_look / 2);
  const double late                   = mean_step(looked_at, rows_for_look / 2, rows_for_look);
  if (!(early > 0) || !(late > 0) || alike(late * rate, 1) || !alike(early, late))
    return {};  // as before, or it changes just here: the next look tells
  try {
    return rate_of_times(looked_at);
  } catch (const InputError &) {  // too coarse to tell: what falls on one sample is counted as doubled
    return {};
  }
}

void RowTimes::restart()
{
  last_.reset();
  seconds_.clear();
}
}  // namespace mill::live
