#include "report/plot/ticks.h"
#include "report/plot/number.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double tick_rounding = 1e-9;  // an end that is a tick stays one although it was computed

double nice_step(const double rough)
{
  const double decade   = std::pow(10.0, std::floor(std::log10(rough)));
  const double fraction = rough / decade;
  return decade * (fraction < 1.5 ? 1 : fraction < 3.5 ? 2 : fraction < 7.5 ? 5 : 10);
}

std::string label_of(const double value)
{
  return significant(value, value < 1 ? 1 : int(std::floor(std::log10(value) + tick_rounding)) + 1);
}
}  // namespace

Ticks linear_ticks(const double low, const double high, const int wanted)
{
  const double step = nice_step((high - low) / wanted);
  if (!(step > 0) || !std::isfinite(step) || !(std::max(std::abs(low), std::abs(high)) < 1e15 * step))
    return {};  // a range beyond the digits of a double has no ticks, and counting them might not end
  const int decimals = std::max(0, -int(std::floor(std::log10(step) + tick_rounding)));
  Ticks ticks;
  const double last = std::floor(high / step + tick_rounding);
  for (double i = std::ceil(low / step - tick_rounding); i <= last; ++i) {
    ticks.at.push_back(i * step);
    ticks.labels.push_back(fixed(i * step, decimals));
  }
  return ticks;
}

Ticks log_ticks(const double low, const double high, const int wanted)
{
  if (!(low > 0) || !std::isfinite(high))
    return {};
  const int first   = int(std::floor(std::log10(low) + tick_rounding));
  const int last    = int(std::floor(std::log10(high) + tick_rounding));
  const bool few    = std::log10(high / low) < 2;
  const int every   = std::max(1, int(std::ceil((last - first) / double(wanted))));
  const auto inside = [&](const double v) {
    return v >= low * (1 - tick_rounding) && v <= high * (1 + tick_rounding);
  };
  Ticks ticks;
  for (int decade = first; decade <= last; ++decade)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      if (!inside(value))
        continue;
      const bool labelled = digit == 1 ? decade % every == 0 : few && (digit == 2 || digit == 5);
      if (labelled) {
        ticks.at.push_back(value);
        ticks.labels.push_back(digit == 1 ? power_of_ten(decade) : label_of(value));
      } else if (every == 1)
        ticks.minor.push_back(value);
    }
  return ticks;
}
}  // namespace mill::report
