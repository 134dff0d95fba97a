#pragma once
#include <string>

namespace mill {
/// A number with a few significant digits, for sentences and scripts: "0.9794", "1.2e-05"; decimal point in every
/// locale.  Numbers of the page have a typography of their own (report/plot/number.h), those that are read back
/// every digit (number_text).
std::string short_number(double value, int digits = 4);
/// Significant digits of a value that its error allows: the last one is the first digit of the error, or its
/// second where the error begins with a number below 3.55 (rule of the Particle Data Group).
/// @param relative_error  of the value; NaN or zero: not known, all digits are allowed
/// @return 1 .. most_digits
int known_digits(double value, double relative_error, int most_digits);
/// A number with these digits, without exponent from 1e-4 to 1e7: 60.3838 with 0.64 is "60", 39948.2 with 0.004 is
/// "39950"; zeros at the end are significant and stay, unless the error is not known.
std::string number_within(double value, double relative_error, int most_digits = 5);
/// "64 %", "0.31 %": a relative error as percent, two digits.
std::string percent_text(double relative_error);
/// A number with `decimals` digits behind the point: "0.500".
std::string fixed_number(double value, int decimals);
/// The same without zeros at its end: "0.5", "12".
std::string decimal_number(double value, int decimals);
}  // namespace mill
