#include "twin/cleaning/described_channel.h"
#include "core/base/si_unit.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace mill::twin {
namespace {
constexpr double most_changes     = 0.01;  // of the samples, of a set value
constexpr double least_equal      = 0.99;  // of the steps, of a counter
constexpr double same_step        = 1e-6;  // relative
constexpr double digits_of_float  = 6e-8;  // relative, of a number that was stored in four bytes
constexpr Eigen::Index few_values = 100;   // below, a shape says nothing

struct Shape {
  std::vector<double> value;  // without the missing ones
  double low = 0, high = 0;
  Eigen::Index rises = 0, falls = 0;
  bool has_two_values = true;
};

Shape shape_of_channel(const Eigen::VectorXd &all)
{
  Shape shape;
  shape.value.reserve(std::size_t(all.size()));
  for (const double x : all)
    if (!std::isnan(x))
      shape.value.push_back(x);
  if (shape.value.empty())
    return shape;
  const auto [low, high] = std::minmax_element(shape.value.begin(), shape.value.end());
  shape.low              = *low;
  shape.high             = *high;
  for (std::size_t i = 0; i < shape.value.size(); ++i) {
    shape.has_two_values = shape.has_two_values && (shape.value[i] == shape.low || shape.value[i] == shape.high);
    if (i > 0) {
      shape.rises += shape.value[i] > shape.value[i - 1];
      shape.falls += shape.value[i] < shape.value[i - 1];
    }
  }
  return shape;
}

// The step that nearly all neighbours have, 0: none.  `others` is the number of steps that differ.
double common_step(const Shape &shape, Eigen::Index &others)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < shape.value.size(); ++i)
    steps.push_back(shape.value[i] - shape.value[i - 1]);
  auto sorted       = steps;
  const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double step = *middle;
  const double tolerance =
      same_step * std::abs(step) + digits_of_float * std::max(std::abs(shape.low), std::abs(shape.high));
  others =
      std::count_if(steps.begin(), steps.end(), [&](const double s) { return std::abs(s - step) > tolerance; });
  return std::abs(step) > 4 * tolerance && double(others) <= (1 - least_equal) * double(steps.size()) ? step : 0;
}

std::string range_text(const Shape &shape, const std::string &unit)
{
  return fmt::format("{:.6g} to {:.6g}{}", shape.low, shape.high, after_number(unit));
}
}  // namespace

std::optional<DescribedChannel> described(const RawChannel &channel)
{
  if (channel.quantity == Quantity::speed)
    return {};
  const Shape shape = shape_of_channel(channel.value);
  const auto n      = Eigen::Index(shape.value.size());
  DescribedChannel result{channel.name, channel.column, channel.unit, "", "", shape.low, shape.high};
  const auto named = [&](const char *kind, const std::string &more) {
    result.kind     = kind;
    result.sentence = kind + more;
    return result;
  };
  if (n == 0) {
    result.lowest = result.highest = std::nan("");
    return named("empty", ", without a number");
  }
  const std::string unit = after_number(channel.unit);
  if (shape.low == shape.high)
    return named("constant", fmt::format(", {:.6g}{}", shape.low, unit));
  if (n < few_values)
    return {};
  if (shape.has_two_values)
    return named("switch", fmt::format(" between {:.6g} and {:.6g}{}, changed {} times", shape.low, shape.high,
                                       unit, shape.rises + shape.falls));
  Eigen::Index others = 0;
  if (const double step = common_step(shape, others); step != 0)
    return named("counter", fmt::format(", step {:.6g}, from {}{}", step, range_text(shape, channel.unit),
                                        others > 0 ? fmt::format(", with {} other steps", others) : ""));
  if (double(shape.rises + shape.falls) < most_changes * double(n))
    return named("set value", fmt::format(", changed {} times, from {}", shape.rises + shape.falls,
                                          range_text(shape, channel.unit)));
  if (shape.rises == 0 || shape.falls == 0)
    return named("ramp", fmt::format(", {} from {}", shape.falls == 0 ? "rising" : "falling",
                                     range_text(shape, channel.unit)));
  return {};
}
}  // namespace mill::twin
