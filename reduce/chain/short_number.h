#pragma once
#include <locale>
#include <sstream>
#include <string>

namespace mill::reduce {
/// A number with a few significant digits, for sentences.
inline std::string short_number(const double value, const int digits = 4)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << value;
  return text.str();
}
}  // namespace mill::reduce
