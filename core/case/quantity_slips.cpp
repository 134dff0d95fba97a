#include "core/case/quantity_slips.h"
#include "core/base/units.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double free_fall = 9.80665, pound = 0.45359237, inch = 0.0254;  // exact by definition

bool is_digit(const char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// Characters at the beginning that may belong to a number in any locale: a separator only between two digits.
std::size_t length_of_number(const std::string &text)
{
  std::size_t end = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool between = i > 0 && is_digit(text[i - 1]) && i + 1 < text.size() && is_digit(text[i + 1]);
    const bool sign    = i == 0 && (text[i] == '-' || text[i] == '+');
    if (is_digit(text[i]))
      end = i + 1;
    else if (!sign && !(between && std::string(",.' ").find(text[i]) != std::string::npos))
      break;
  }
  return end;
}

std::string without(std::string text, const std::string &characters)
{
  text.erase(std::remove_if(text.begin(), text.end(),
                            [&](const char c) { return characters.find(c) != std::string::npos; }),
             text.end());
  return text;
}

std::string with_point_at(const std::string &number, const std::size_t comma)
{
  return without(number.substr(0, comma), ",.' ") + "." + number.substr(comma + 1);
}

// The readings of a number alone.
std::vector<std::string> readings(const std::string &number)
{
  const auto commas = std::count(number.begin(), number.end(), ','),
             points = std::count(number.begin(), number.end(), '.');
  const bool gaps   = number.find_first_of("' ") != std::string::npos;
  const auto last   = number.find_last_of(",.");
  if (commas == 0 && points < 2)
    return gaps ? std::vector<std::string>{without(number, "' ")} : std::vector<std::string>{};
  if (commas > 0 && points > 0)
    return {with_point_at(number, last)};
  if (commas + points > 1)
    return {without(number, ",.' ")};
  const std::string before = without(number.substr(0, last), "+-");
  const bool thousands     = number.size() - last == 4 && before.size() <= 3 && before != "0" &&
                         before.find_first_of("' ") > before.size();
  std::vector<std::string> all{with_point_at(number, last)};
  if (thousands)
    all.push_back(without(number, ",.' "));
  return all;
}

const ForeignUnit *foreign(const std::string &spelling, const std::string &form)
{
  const ForeignUnit *any = nullptr;
  for (const ForeignUnit &u : foreign_units())
    if (spelling == u.spelling) {
      if (unit(u.like).dimension == unit(form).dimension)
        return &u;
      any = any ? any : &u;
    }
  return any;
}

std::string rounded(const double value, const std::string &form)
{
  return fmt::format("{:.6g} {}", value, form);
}

// A reading as it should be written, or empty when it is not a quantity of this unit in its range.
std::string as_written(const std::string &text, const std::string &form, const Range &range)
{
  double number = 0;
  if (form == "1")
    return parse_number(text, number) && inside(number, range) ? number_text(number) : "";
  const ParsedQuantity parsed = parse_quantity(text);
  if (parsed.fault == ParsedQuantity::Fault::none)
    return parsed.unit->dimension == unit(form).dimension && inside(from_si(parsed.value(), unit(form)), range)
               ? quoted(text)
               : "";
  if (parsed.fault != ParsedQuantity::Fault::unknown_unit)
    return "";
  const ForeignUnit *u = foreign(parsed.unit_text, form);
  if (!u || !(unit(u->like).dimension == unit(form).dimension))
    return "";
  const double converted = from_si(parsed.number * u->factor, unit(form));
  return inside(converted, range) ? quoted(rounded(converted, form)) : "";
}

std::string stripped(std::string text)
{
  text.erase(0, std::min(text.find_first_not_of(" \t"), text.size()));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
}

// "57 1/16 in" with a decimal fraction, "57.0625 in"; empty when there is no fraction of an inch in it.
std::string without_fraction(const std::string &text)
{
  const auto slash = text.find('/');
  if (slash == std::string::npos || slash == 0 || !is_digit(text[slash - 1]))
    return "";
  std::size_t begin = slash, end = slash + 1;
  while (begin > 0 && is_digit(text[begin - 1]))
    --begin;
  while (end < text.size() && is_digit(text[end]))
    ++end;
  const std::string unit_text = stripped(text.substr(end)), whole_text = stripped(text.substr(0, begin));
  const ForeignUnit *u = foreign(unit_text, "mm");
  double whole = 0, above = 0, below = 0;
  const bool has_whole = !whole_text.empty();
  if (!u || u->factor != inch || (has_whole && !parse_number(whole_text, whole)) ||
      !parse_number(text.substr(begin, slash - begin), above) ||
      !parse_number(text.substr(slash + 1, end - slash - 1), below) || below == 0)
    return "";
  return fmt::format("{:.10g} in", whole + above / below);
}

// Without what a drawing writes around a number: a sign of a diameter in front, a tolerance behind.  Empty when
// there is nothing of the kind.
std::string without_drawing_signs(const std::string &text)
{
  std::string rest = stripped(text);
  for (const char *sign : {"\u00f8", "\u00d8", "\u2300", "\u2205", "dia.", "dia", "~", "\u2248", "ca.", "approx."})
    if (const std::string before = sign; rest.rfind(before, 0) == 0) {
      rest = stripped(rest.substr(before.size()));
      break;
    }
  for (const char *sign : {"\u00b1", "+/-", "+-"})
    if (const auto position = rest.find(sign); position != std::string::npos) {
      const std::string before = stripped(rest.substr(0, position));
      const auto unit_begin    = rest.find_last_of("0123456789.") + 1;
      const bool has_unit      = !before.empty() && !is_digit(before.back());
      rest                     = has_unit ? before : before + " " + stripped(rest.substr(unit_begin));
      break;
    }
  return rest == stripped(text) ? "" : rest;
}

// Fractions of an inch, signs of a drawing, a percentage for a pure number, turns where a surface speed is needed.
std::string unusual_form(const std::string &text, const std::string &form, const Range &range)
{
  const ParsedQuantity parsed = parse_quantity(text);
  const bool plain            = parsed.fault == ParsedQuantity::Fault::none;
  if (form == "1") {
    const bool percent = plain && parsed.unit->dimension == unit("%").dimension;
    return percent && inside(parsed.value(), range)
               ? fmt::format("is a percentage; write {}", number_text(parsed.value()))
               : "";
  }
  if (plain && parsed.unit->dimension == unit("rpm").dimension && unit(form).dimension == unit("m/s").dimension)
    return fmt::format("is a number of turns in a time; the speed of the surface is needed, pi x diameter x turns "
                       "per second: a roll of "
                       "1 m has {:.6g} m/s",
                       M_PI * parsed.value());
  if (const std::string decimal = without_fraction(text); !decimal.empty())
    if (const std::string written = as_written(decimal, form, range); !written.empty())
      return fmt::format("has a fraction of an inch; {} = {}: write {}", text, decimal, written);
  if (const std::string bare = without_drawing_signs(text); !bare.empty())
    if (const std::string written = as_written(bare, form, range); !written.empty())
      return fmt::format("has more than a number and a unit; write {}", written);
  return "";
}

std::string foreign_remedy(const ParsedQuantity &parsed, const std::string &form, const Range &range)
{
  const ForeignUnit *u = foreign(parsed.unit_text, form);
  if (!u)
    return "";
  if (!(unit(u->like).dimension == unit(form).dimension))
    return fmt::format("is in {}, {}; {} is needed", u->name, unit(u->like).quantity, unit(form).quantity);
  const double converted    = from_si(parsed.number * u->factor, unit(form));
  const std::string written = rounded(converted, form);
  const std::string equal = fmt::format("is in {}; {:.10g} {} = {}", u->name, parsed.number, u->spelling, written);
  if (!inside(converted, range))
    return fmt::format("{}, which is outside {}", equal, range_in(range, form));
  return fmt::format("{}: write {}", equal, quoted(written));
}
}  // namespace

const std::vector<ForeignUnit> &foreign_units()
{
  static const std::vector<ForeignUnit> units{
      {"in", "inches", inch, "mm"},
      {"inch", "inches", inch, "mm"},
      {"inches", "inches", inch, "mm"},
      {"\"", "inches", inch, "mm"},
      {"''", "inches", inch, "mm"},
      {"\u2033", "inches", inch, "mm"},
      {"ft", "feet", 12 * inch, "mm"},
      {"mil", "thousandths of an inch", inch / 1000, "mm"},
      {"cm", "centimetres", 0.01, "mm"},
      {"dm", "decimetres", 0.1, "mm"},
      {"micron", "micrometres", 1e-6, "um"},
      {"lb", "pounds", pound, "kg"},
      {"lbs", "pounds", pound, "kg"},
      {"ton", "metric tons, if they are", 1000, "kg"},
      {"tons", "metric tons, if they are", 1000, "kg"},
      {"tonne", "metric tons", 1000, "kg"},
      {"ton", "metric tons of force, if they are", 1000 * free_fall, "kN"},
      {"tons", "metric tons of force, if they are", 1000 * free_fall, "kN"},
      {"t", "metric tons of force", 1000 * free_fall, "kN"},
      {"tonf", "metric tons of force", 1000 * free_fall, "kN"},
      {"tf", "metric tons of force", 1000 * free_fall, "kN"},
      {"kgf", "kilograms of force", free_fall, "kN"},
      {"kp", "kiloponds", free_fall, "kN"},
      {"daN", "decanewtons", 10, "kN"},
      {"lbf", "pounds of force", pound * free_fall, "kN"},
      {"kip", "kilopounds of force", 1000 * pound * free_fall, "kN"},
      {"kgf/mm2", "kilograms of force per mm2", free_fall * 1e6, "MPa"},
      {"kp/mm2", "kiloponds per mm2", free_fall * 1e6, "MPa"},
      {"kg/mm2", "kilograms of force per mm2", free_fall * 1e6, "MPa"},
      {"kgf/cm2", "kilograms of force per cm2", free_fall * 1e4, "MPa"},
      {"kp/cm2", "kiloponds per cm2", free_fall * 1e4, "MPa"},
      {"psi", "pounds of force per square inch", pound * free_fall / inch / inch, "MPa"},
      {"ksi", "kilopounds of force per square inch", 1000 * pound * free_fall / inch / inch, "MPa"},
      {"tf/mm", "metric tons of force per mm", 1e6 * free_fall, "kN/mm"},
      {"tonf/mm", "metric tons of force per mm", 1e6 * free_fall, "kN/mm"},
      {"t/mm", "metric tons of force per mm", 1e6 * free_fall, "kN/mm"},
      {"ton/mm", "metric tons of force per mm, if they are", 1e6 * free_fall, "kN/mm"},
      {"kgf/mm", "kilograms of force per mm", 1000 * free_fall, "kN/mm"},
      {"lbf/in", "pounds of force per inch", pound * free_fall / inch, "kN/mm"},
      {"mpm", "metres per minute", 1. / 60, "m/s"},
      {"fpm", "feet per minute", 12 * inch / 60, "m/s"},
      {"ft/min", "feet per minute", 12 * inch / 60, "m/s"},
      {"km/h", "kilometres per hour", 1 / 3.6, "m/s"},
      {"1/min", "revolutions per minute", 1. / 60, "rpm"},
      {"r/min", "revolutions per minute", 1. / 60, "rpm"},
      {"U/min", "revolutions per minute", 1. / 60, "rpm"},
      {"\u00b0", "degrees", M_PI / 180, "deg"},
      {"cP", "centipoises", 1e-3, "Pa s"},
      {"hp", "horsepower", 745.69987158227022, "kW"},
      {"PS", "metric horsepower", 75 * free_fall, "kW"},
      {"Nm", "newton metres", 1, "kN m"},
      {"kNm", "kilonewton metres", 1000, "kN m"},
      {"kgf m", "kilogram-metres of force", free_fall, "kN m"},
      {"g/cm3", "grams per cm3", 1000, "kg/m3"},
      {"kg/dm3", "kilograms per dm3", 1000, "kg/m3"},
      {"lb/in3", "pounds per cubic inch", pound / inch / inch / inch, "kg/m3"},
  };
  return units;
}

bool inside(const double number, const Range &range)
{
  constexpr double rounding = 1e-14;  // of range ends and values, some 1e-16 each
  const auto slack          = [](const double end) { return std::isfinite(end) ? rounding * std::abs(end) : 0; };
  return number >= range.min - slack(range.min) && number <= range.max + slack(range.max);
}

std::vector<std::string> with_decimal_point(const std::string &text)
{
  const std::size_t end = length_of_number(text);
  std::vector<std::string> all;
  for (const std::string &number : readings(text.substr(0, end)))
    all.push_back(number + text.substr(end));
  return all;
}

bool has_decimal_comma(const std::string &text)
{
  const std::string number = text.substr(0, length_of_number(text));
  const auto last          = number.find_last_of(",.");
  return last != std::string::npos && number[last] == ',' && std::count(number.begin(), number.end(), ',') == 1 &&
         readings(number).size() == 1;
}

std::vector<std::string> readings_of_point(const std::string &text)
{
  const std::size_t end   = length_of_number(text);
  const std::string point = text.substr(0, end);
  std::string comma       = point;
  std::replace(comma.begin(), comma.end(), '.', ',');
  if (point.find(',') != std::string::npos || comma == point || readings(comma).size() != 2)
    return {};
  return {point + text.substr(end), without(point, ".") + text.substr(end)};
}

std::string quantity_remedy(const std::string &text, const std::string &form, const Range &range)
{
  std::vector<std::string> meant;
  for (const std::string &reading : with_decimal_point(text))
    if (const std::string written = as_written(reading, form, range); !written.empty())
      meant.push_back(written);
  const bool comma = text.find(',') != std::string::npos;
  if (meant.size() == 2)
    return fmt::format("has a comma that may stand for a decimal point or for thousands; write {} or {}", meant[0],
                       meant[1]);
  if (meant.size() == 1)
    return fmt::format("has {}; write {}", comma ? "a comma in its number" : "a separator in its number",
                       meant[0]);
  if (const std::string unusual = unusual_form(text, form, range); form == "1" || !unusual.empty())
    return unusual;
  const ParsedQuantity parsed = parse_quantity(text);
  const bool force_in_tons    = parsed.fault == ParsedQuantity::Fault::none &&
                             std::string(parsed.unit->symbol) == "t" &&
                             unit(form).dimension == unit("N").dimension;
  if (parsed.fault == ParsedQuantity::Fault::unknown_unit || force_in_tons)
    return foreign_remedy(parsed, form, range);
  return "";
}
}  // namespace mill
