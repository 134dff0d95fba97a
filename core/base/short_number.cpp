#include "core/base/short_number.h"
#include <array>
#include <charconv>

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
