#include "core/base/short_number.h"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace mill {
namespace {
std::string written(const double value, const std::chars_format format, const int digits)
{
  std::array<char, 400> text;  // the largest double has 309 digits before the point
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits);
  return std::string(text.data(), end.ptr);
}
}  // namespace

std::string short_number(const double value, const int digits)
{
  return written(value, std::chars_format::general, digits);
}

int known_digits(const double value, const double relative_error, const int most_digits)
{
  const double error = std::abs(value * relative_error);
  if (!std::isfinite(error) || error == 0)
    return most_digits;
  const int first = int(std::floor(std::log10(error)));  // decade of the first digit of the error
  const int last  = error / std::pow(10.0, first) < 3.55 ? first - 1 : first;
  return std::clamp(int(std::floor(std::log10(std::abs(value)))) - last + 1, 1, most_digits);
}

std::string number_within(const double value, const double relative_error, const int most_digits)
{
  const int digits          = known_digits(value, relative_error, most_digits);
  const std::string rounded = written(value, std::chars_format::scientific, digits - 1);  // "1.02e+04"
  const std::size_t mark    = rounded.find('e');
  if (mark == std::string::npos)  // infinity, NaN
    return rounded;
  const int exponent = std::stoi(rounded.substr(mark + 1));
  if (exponent < -4 || exponent > 6)
    return rounded;
  const bool known   = std::isfinite(value * relative_error) && value * relative_error != 0;
  const int decade   = value == 0 ? 0 : int(std::floor(std::log10(std::abs(value))));
  const int decimals = std::max(0, digits - 1 - decade);
  return known ? fixed_number(std::stod(rounded), decimals) : decimal_number(std::stod(rounded), decimals);
}

std::string percent_text(const double relative_error)
{
  return number_within(100 * relative_error, 0, 2) + " %";
}

std::string fixed_number(const double value, const int decimals)
{
  return written(value, std::chars_format::fixed, decimals);
}

std::string decimal_number(const double value, const int decimals)
{
  std::string text = fixed_number(value, decimals);
  if (text.find('.') != std::string::npos)
    text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text.pop_back();
  return text;
}
}  // namespace mill
