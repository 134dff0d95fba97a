#include "core/numerics/short_number.h"
#include <array>
#include <charconv>

namespace mill {
std::string short_number(const double value, const int digits)
{
  std::array<char, 40> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return std::string(text.data(), end.ptr);
}
}  // namespace mill
