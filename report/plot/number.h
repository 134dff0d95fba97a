#pragma once
#include <string>

// Numbers as the report shows them.  All functions write a decimal point in every locale, a true minus sign and
// a narrow no-break space between thousands; NaN and infinity become an en dash.
namespace mill::report {
constexpr double standard_gravity = 9.80665;  ///< m/s2, exact by definition (CGPM 1901)

/// `digits` significant digits: "40 192", "0.9794", "1.24 × 10⁻⁵" below 1e-3 and from 1e7 on.
std::string significant(double value, int digits = 4);

/// A value with the digits that its error allows: 60.38 with 0.64 is "60", 39 948.2 with 0.004 is "39 950".  The
/// last digit printed is the one in which the error has its first digit, or its second where the error begins with
/// a number below 3.55, the rule of the Particle Data Group.
/// @param relative_error  of the value; NaN and zero: not known, all `most_digits` are printed
/// @param most_digits     significant digits at most, >= 1
std::string known_digits(double value, double relative_error, int most_digits = 4);

/// A frequency in Hz with the digits that its error allows and at most one decimal.
std::string frequency_text(double frequency, double relative_error);

/// How far a value may be off: accuracy(0.64) = "\u00b164 %", two significant digits; "\u00b10 %" below 5e-6.
std::string accuracy(double relative_error);

/// Fixed number of decimals: fixed(38.907, 1) = "38.9".
std::string fixed(double value, int decimals);

/// A deviation with its sign: percent(0.0123) = "+1.2 %"; two significant digits below 1 %, at most one decimal.
std::string percent(double fraction);

/// "10⁻⁴"; 0.001 .. 10000 are written out.
std::string power_of_ten(int exponent);

/// SVG coordinate: two decimals at most, hyphen as minus, no grouping.
std::string pixel(double value);

/// A value in the unit an engineer reads.
struct Shown {
  double value;      ///< in `unit`
  std::string unit;  ///< "" for a pure number
};

/// From SI to the unit of the mill floor: N/m -> kN/mm, Pa -> MPa, Pa s -> mPa s, N -> kN, m -> mm or um, m/s2 ->
/// g, rad -> degrees or mrad. Units that are not in the table stay as they are.
Shown engineering(double value, const std::string &si_unit);

/// SI unit with proper signs for the page: "m/s2" -> "m/s²", "um" -> "µm", "sqrt(Hz)" -> "√Hz", "1" -> "".
std::string unit_sign(const std::string &unit);
}  // namespace mill::report
