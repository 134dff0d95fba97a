#include "core/base/units.h"
#include "core/base/short_number.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mill {
namespace {
constexpr double g0 = 9.80665;  // m/s2, standard acceleration of free fall (CGPM 1901)

//                            L   M   T  temperature angle
constexpr Dimension none{};
constexpr Dimension length{1};
constexpr Dimension area{2};
constexpr Dimension mass{0, 1};
constexpr Dimension time{0, 0, 1};
constexpr Dimension temperature{0, 0, 0, 1};
constexpr Dimension angle{0, 0, 0, 0, 1};
constexpr Dimension frequency{0, 0, -1};
constexpr Dimension angular_speed{0, 0, -1, 0, 1};
constexpr Dimension speed{1, 0, -1};
constexpr Dimension acceleration{1, 0, -2};
constexpr Dimension force{1, 1, -2};
constexpr Dimension stiffness{0, 1, -2};
constexpr Dimension damping{0, 1, -1};
constexpr Dimension pressure{-1, 1, -2};
constexpr Dimension compliance{1, -1, 2};
constexpr Dimension curvature{-1};
constexpr Dimension density{-3, 1};
constexpr Dimension viscosity{-1, 1, -1};
constexpr Dimension energy{2, 1, -2};
constexpr Dimension specific_heat{2, 0, -2, -1};
constexpr Dimension power{2, 1, -3};

// "N s/m", "N.s/m", "N*s/m" and "N·s/m" become "N s/m"; the two micro signs become u; "m/s^2" becomes "m/s2",
// "J/(kg K)" "J/kg K".
std::string normalised(const std::string_view spelling)
{
  static constexpr std::pair<std::string_view, char> signs[] = {{"\u00b5", 'u'}, {"\u03bc", 'u'}, {"\u00b7", ' '}};
  std::string text;
  for (std::size_t i = 0; i < spelling.size(); ++i) {
    const auto sign = std::find_if(std::begin(signs), std::end(signs),
                                   [&](const auto &one) { return spelling.substr(i, 2) == one.first; });
    if (sign != std::end(signs)) {
      text += sign->second;
      ++i;
    } else if (spelling[i] == '.' || spelling[i] == '*' || spelling[i] == '\t') {
      text += ' ';
    } else if (spelling[i] != '^' && spelling[i] != '(' && spelling[i] != ')') {
      text += spelling[i];
    }
  }
  std::string single;
  for (const char c : text)
    if (c != ' ' || (!single.empty() && single.back() != ' '))
      single += c;
  while (!single.empty() && single.back() == ' ')
    single.pop_back();
  return single;
}

std::string_view trimmed(std::string_view text)
{
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

// Number at the beginning of a text; returns how many characters it takes, 0 when there is none.
std::size_t leading_number(const std::string_view text, double &number)
{
  const bool has_plus     = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const std::size_t sign  = has_plus ? 1 : 0;  // from_chars knows no plus sign
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number))
    return 0;
  return std::size_t(end - text.data());
}

// Fewest digits of a number near `number` that convert to exactly `value`; empty when there is none.
std::string exact_text(const double value, const double number, const Unit &u)
{
  for (int precision = 1; precision <= 17; ++precision) {
    const std::string text = short_number(number, precision);
    double back            = 0;
    if (parse_number(text, back) && to_si(back, u) == value)
      return number_text(back);
  }
  return "";
}
}  // namespace

bool operator==(const Dimension &a, const Dimension &b)
{
  return a.length == b.length && a.mass == b.mass && a.time == b.time && a.temperature == b.temperature &&
         a.angle == b.angle;
}

const std::vector<Unit> &all_units()
{
  static const std::vector<Unit> units{
      {"1", none, 1, 1, 0, "a pure number"},
      {"%", none, 1, 100, 0, "a percentage"},
      {"m", length, 1, 1, 0, "a length"},
      {"mm", length, 1, 1e3, 0, "a length"},
      {"um", length, 1, 1e6, 0, "a length"},
      {"m2", area, 1, 1, 0, "an area"},
      {"mm2", area, 1, 1e6, 0, "an area"},
      {"kg", mass, 1, 1, 0, "a mass"},
      {"t", mass, 1e3, 1, 0, "a mass"},
      {"s", time, 1, 1, 0, "a time"},
      {"ms", time, 1, 1e3, 0, "a time"},
      {"us", time, 1, 1e6, 0, "a time"},
      {"min", time, 60, 1, 0, "a time"},
      {"K", temperature, 1, 1, 0, "a temperature"},
      {"degC", temperature, 1, 1, 273.15, "a temperature"},
      {"rad", angle, 1, 1, 0, "an angle"},
      {"mrad", angle, 1, 1e3, 0, "an angle"},
      {"deg", angle, M_PI, 180, 0, "an angle"},
      {"Hz", frequency, 1, 1, 0, "a frequency"},
      {"kHz", frequency, 1e3, 1, 0, "a frequency"},
      {"rpm", frequency, 1, 60, 0, "a frequency"},
      {"rad/s", angular_speed, 1, 1, 0, "an angular speed"},
      {"m/s", speed, 1, 1, 0, "a speed"},
      {"mm/s", speed, 1, 1e3, 0, "a speed"},
      {"m/min", speed, 1, 60, 0, "a speed"},
      {"m/s2", acceleration, 1, 1, 0, "an acceleration"},
      {"g", acceleration, g0, 1, 0, "an acceleration"},
      {"N", force, 1, 1, 0, "a force"},
      {"kN", force, 1e3, 1, 0, "a force"},
      {"MN", force, 1e6, 1, 0, "a force"},
      {"N/m", stiffness, 1, 1, 0, "a stiffness"},
      {"N/um", stiffness, 1e6, 1, 0, "a stiffness"},
      {"kN/mm", stiffness, 1e6, 1, 0, "a stiffness"},
      {"MN/m", stiffness, 1e6, 1, 0, "a stiffness"},
      {"kN/um", stiffness, 1e9, 1, 0, "a stiffness"},
      {"MN/mm", stiffness, 1e9, 1, 0, "a stiffness"},
      {"GN/m", stiffness, 1e9, 1, 0, "a stiffness"},
      {"N/mm", stiffness, 1e3, 1, 0, "a line load"},
      {"kN/m", stiffness, 1e3, 1, 0, "a line load"},
      {"N s/m", damping, 1, 1, 0, "a damping"},
      {"kN s/m", damping, 1e3, 1, 0, "a damping"},
      {"N s/mm", damping, 1e3, 1, 0, "a damping"},
      {"kN s/mm", damping, 1e6, 1, 0, "a damping"},
      {"Pa", pressure, 1, 1, 0, "a stress"},
      {"kPa", pressure, 1e3, 1, 0, "a stress"},
      {"MPa", pressure, 1e6, 1, 0, "a stress"},
      {"GPa", pressure, 1e9, 1, 0, "a stress"},
      {"N/m2", pressure, 1, 1, 0, "a stress"},
      {"N/mm2", pressure, 1e6, 1, 0, "a stress"},
      {"kN/mm2", pressure, 1e9, 1, 0, "a stress"},
      {"bar", pressure, 1e5, 1, 0, "a stress"},
      {"1/Pa", compliance, 1, 1, 0, "a pressure coefficient"},
      {"1/MPa", compliance, 1, 1e6, 0, "a pressure coefficient"},
      {"1/GPa", compliance, 1, 1e9, 0, "a pressure coefficient"},
      {"1/m", curvature, 1, 1, 0, "a reciprocal length"},
      {"1/mm", curvature, 1e3, 1, 0, "a reciprocal length"},
      {"1/um", curvature, 1e6, 1, 0, "a reciprocal length"},
      {"kg/m3", density, 1, 1, 0, "a density"},
      {"t/m3", density, 1e3, 1, 0, "a density"},
      {"Pa s", viscosity, 1, 1, 0, "a viscosity"},
      {"mPa s", viscosity, 1, 1e3, 0, "a viscosity"},
      {"J", energy, 1, 1, 0, "an energy"},
      {"kJ", energy, 1e3, 1, 0, "an energy"},
      {"N m", energy, 1, 1, 0, "a torque"},
      {"kN m", energy, 1e3, 1, 0, "a torque"},
      {"J/kg K", specific_heat, 1, 1, 0, "a specific heat"},
      {"W", power, 1, 1, 0, "a power"},
      {"kW", power, 1e3, 1, 0, "a power"},
      {"MW", power, 1e6, 1, 0, "a power"},
  };
  return units;
}

const Unit *find_unit(const std::string_view spelling)
{
  const std::string symbol = normalised(spelling);
  for (const Unit &u : all_units())
    if (symbol == u.symbol)
      return &u;
  return nullptr;
}

const Unit &unit(const std::string_view symbol)
{
  const Unit *known = find_unit(symbol);
  if (!known)
    throw std::logic_error("there is no unit " + std::string(symbol));  // a table of this program names it
  return *known;
}

double to_si(const double number, const Unit &u)
{
  return number * u.multiply / u.divide + u.offset;
}

double from_si(const double value, const Unit &u)
{
  return (value - u.offset) * u.divide / u.multiply;
}

double ParsedQuantity::value() const
{
  return to_si(number, *unit);
}

ParsedQuantity parse_quantity(const std::string_view text)
{
  using Fault = ParsedQuantity::Fault;
  ParsedQuantity parsed;
  const std::string_view all = trimmed(text);
  const std::size_t used     = leading_number(all, parsed.number);
  parsed.unit_text           = std::string(trimmed(all.substr(used)));
  if (used == 0)
    parsed.fault = Fault::no_number;
  else if (parsed.unit_text.empty())
    parsed.fault = Fault::no_unit;
  else if (parsed.unit = find_unit(parsed.unit_text); !parsed.unit)
    parsed.fault = Fault::unknown_unit;
  else if (!std::isfinite(parsed.value()))
    parsed.fault = Fault::no_number;
  return parsed;
}

bool parse_number(const std::string_view text, double &number)
{
  const std::string_view all = trimmed(text);
  return !all.empty() && leading_number(all, number) == all.size();
}

std::string number_text(const double value)
{
  if (!std::isfinite(value))
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  char text[64];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return std::string(text, result.ptr);
}

const Unit &si_unit(const Unit &u)
{
  for (const Unit &other : all_units())
    if (other.dimension == u.dimension && other.multiply == 1 && other.divide == 1 && other.offset == 0)
      return other;
  return u;
}

std::string quantity_text(const double value, const Unit &u)
{
  const double number = from_si(value, u);
  for (const double near : {number, std::nextafter(number, -HUGE_VAL), std::nextafter(number, HUGE_VAL)})
    if (const std::string text = exact_text(value, near, u); !text.empty())
      return text + " " + u.symbol;
  return number_text(value) + " " + si_unit(u).symbol;
}

std::string units_like(const Unit &u)
{
  std::string list;
  for (const Unit &other : all_units())
    if (other.dimension == u.dimension)
      list += (list.empty() ? "" : ", ") + std::string(other.symbol);
  return list;
}
}  // namespace mill
