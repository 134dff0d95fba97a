#pragma once
#include <string>

namespace mill {
/// A number with a few significant digits, for sentences and scripts: "0.9794", "1.2e-05"; decimal point in every
/// locale.  Numbers of the page have a typography of their own (report/plot/number.h), those that are read back
/// every digit (number_text).
std::string short_number(double value, int digits = 4);
/// A number with `decimals` digits behind the point: "0.500".
std::string fixed_number(double value, int decimals);
/// The same without zeros at its end: "0.5", "12".
std::string decimal_number(double value, int decimals);
}  // namespace mill
