#include "core/base/force_text.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace mill {
namespace {
constexpr int most_decimals = 6;

bool has_decimals(const double x, const int decimals)
{
  const double scaled = std::abs(x) * std::pow(10.0, decimals);
  return std::abs(scaled - std::round(scaled)) <= 1e-9 * scaled;
}

int decimals_of(const double x)
{
  if (x == 0 || !std::isfinite(x))
    return 0;
  const auto decimals_with = [&](const int digits) {
    return std::clamp(digits - 1 - int(std::floor(std::log10(std::abs(x)))), 0, most_decimals);
  };
  const int most      = decimals_with(5);
  const int shown     = has_decimals(x, most) ? most : decimals_with(4);
  const double scale  = std::pow(10.0, shown);
  const double number = std::round(x * scale) / scale;
  for (int decimals = 0; decimals < shown; ++decimals)  // without zeros at the end
    if (has_decimals(number, decimals))
      return decimals;
  return shown;
}
}  // namespace

std::string force_text(const double force)
{
  return fmt::format("{:.{}f} kN", force / 1e3, decimals_of(force / 1e3));
}

const char *force_form(const double force)
{
  static constexpr const char *forms[] = {".0f", ".1f", ".2f", ".3f", ".4f", ".5f", ".6f"};
  static_assert(std::size(forms) == most_decimals + 1);
  return forms[decimals_of(force / 1e3)];
}
}  // namespace mill
