#include "report/plot/number.h"
#include "core/base/short_number.h"
#include "core/base/si_unit.h"
#include "core/base/text.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::report {
namespace {
const char *const dash         = "\u2013";
const char *const minus        = "\u2212";
const char *const narrow_space = "\u202f";

std::string plain(const double value, const int decimals)
{
  std::string written = fixed_number(value, decimals);
  if (has_only(written, "-0.") && written[0] == '-')
    written.erase(0, 1);  // no negative zero on paper
  return written;
}

// 12345.6 -> "12 345.6"; four digits stay together, as in printed tables.
std::string grouped(std::string text)
{
  const bool negative = text[0] == '-';
  if (negative)
    text.erase(0, 1);
  const std::size_t whole = std::min(text.find('.'), text.size());
  if (whole > 4)
    for (std::size_t i = whole - 3; i > 0 && i<text.size(); i = i> 3 ? i - 3 : 0)
      text.insert(i, narrow_space);
  return negative ? minus + text : text;
}

int exponent_of(const double value, const int digits)
{
  // Rounding may carry: 9.9996 with four digits is 10.00, exponent 1.
  const int exponent  = int(std::floor(std::log10(std::abs(value))));
  const double scaled = std::abs(value) / std::pow(10.0, exponent);
  return plain(scaled, digits - 1).substr(0, 2) == "10" ? exponent + 1 : exponent;
}

struct Conversion {
  const char *si;
  double factor;
  const char *shown;
};
const Conversion conversions[] = {
    {"N/m", 1e-6, "kN/mm"}, {"N/m2", 1e-6, "kN/mm per m"},       {"N s/m", 1e-3, "kN s/m"}, {"N", 1e-3, "kN"},
    {"N m", 1e-3, "kN m"},  {"N m/rad", 1e-6, "kN m/mrad"},      {"Pa", 1e-6, "MPa"},       {"deg", 1, "\u00b0"},
    {"Pa s", 1e3, "mPa s"}, {"m/s2", 1 / standard_gravity, "g"},
};
}  // namespace

std::string fixed(const double value, const int decimals)
{
  return std::isfinite(value) ? grouped(plain(value, decimals)) : dash;
}

std::string significant(const double value, const int digits)
{
  if (!std::isfinite(value))
    return dash;
  if (value == 0)
    return "0";
  const int exponent = exponent_of(value, digits);
  if (exponent < -3 || exponent >= 7)
    return fixed(value / std::pow(10.0, exponent), digits - 1) + " \u00d7 " + power_of_ten(exponent);
  if (exponent < digits)
    return fixed(value, digits - 1 - exponent);
  const double last = std::pow(10.0, exponent - digits + 1);
  return fixed(std::round(value / last) * last, 0);
}

std::string known_digits(const double value, const double relative_error, const int most_digits)
{
  return significant(value, mill::known_digits(value, relative_error, most_digits));
}

std::string frequency_text(const double frequency, const double relative_error)
{
  if (!std::isfinite(frequency) || frequency == 0)
    return fixed(frequency, 1);
  const int one_decimal = int(std::floor(std::log10(std::abs(frequency)))) + 2;
  return known_digits(frequency, relative_error, std::max(1, one_decimal));
}

std::string accuracy(const double relative_error)
{
  if (!std::isfinite(relative_error))
    return dash;
  const double size = 100 * std::abs(relative_error);
  return "\u00b1" + (size < 5e-4 ? "0" : significant(size, 2)) + "\u00a0%";
}

std::string percent(const double fraction)
{
  if (!std::isfinite(fraction))
    return dash;
  const double value     = 100 * fraction;
  const double size      = std::abs(value);
  const int decimals     = size >= 100 ? 0 : size >= 1 ? 1 : size >= 0.1 ? 2 : 3;
  const std::string text = size < 5e-4 ? "0" : fixed(value, decimals);
  return (value >= 5e-4 ? "+" : "") + text + "\u00a0%";
}

std::string power_of_ten(const int exponent)
{
  if (exponent >= -3 && exponent <= 4)
    return plain(std::pow(10.0, exponent), std::max(0, -exponent));
  static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text                  = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += raised[digit - '0'];
  return text;
}

std::string pixel(const double value)
{
  const std::string text = decimal_number(value, 2);
  return text == "-0" ? "0" : text;
}

Shown engineering(const double value, const std::string &si_unit)
{
  for (const auto &[si, factor, shown] : conversions)
    if (si_unit == si)
      return {value * factor, shown};
  if (is_in(si_unit, SiUnit::metre)) {
    if (std::abs(value) < 1e-4 && value != 0)
      return {value * 1e6, "\u00b5m"};
    return std::abs(value) < 10 ? Shown{value * 1e3, "mm"} : Shown{value, "m"};
  }
  if (is_in(si_unit, SiUnit::radian))  // tilts are small, places round a ring are not
    return std::abs(value) < 0.02 && value != 0 ? Shown{value * 1e3, "mrad"}
                                                : Shown{value * 57.295779513082321, "\u00b0"};
  if (constexpr double hour = 3600; is_in(si_unit, SiUnit::second) && value >= hour)
    return {value / hour, "h"};
  return {value, unit_sign(si_unit)};
}

std::string unit_sign(const std::string &unit)
{
  if (is_pure(unit))
    return "";
  std::string text;
  for (std::size_t i = 0; i < unit.size(); ++i)
    if (unit.substr(i, 4) == "sqrt") {
      text += "\u221a";
      i += 3;
    } else if (unit[i] == '(' || unit[i] == ')')
      continue;  // of sqrt(Hz)
    else if (unit[i] == 'u' && i + 1 < unit.size() && unit[i + 1] == 'm')
      text += "\u00b5";
    else if (unit[i] == '2' && i > 0 && (unit[i - 1] == 's' || unit[i - 1] == 'm'))
      text += "\u00b2";
    else if (unit[i] == '3' && i > 0 && unit[i - 1] == 'm')
      text += "\u00b3";
    else
      text += unit[i];
  return text;
}
}  // namespace mill::report
