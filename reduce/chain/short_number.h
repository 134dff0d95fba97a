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

/// A length as a case file gives it, "120 mm" with its quotes.
inline std::string quoted_mm(const double metres)
{
  return "\"" + short_number(1000 * metres, 6) + " mm\"";
}
}  // namespace mill::reduce
