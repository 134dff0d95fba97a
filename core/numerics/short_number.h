#pragma once
#include <string>

namespace mill {
/// A number with a few significant digits, for sentences and scripts: "0.9794", "1.2e-05"; decimal point in every
/// locale.  Numbers of the page have a typography of their own (report/page/number.h), those that are read back
/// every digit (number_text).
std::string short_number(double value, int digits = 4);
}  // namespace mill
