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
  if (form == "1")
    return "";
  const ParsedQuantity parsed = parse_quantity(text);
  const bool force_in_tons    = parsed.fault == ParsedQuantity::Fault::none &&
                             std::string(parsed.unit->symbol) == "t" &&
                             unit(form).dimension == unit("N").dimension;
  if (parsed.fault == ParsedQuantity::Fault::unknown_unit || force_in_tons)
    return foreign_remedy(parsed, form, range);
  return "";
}
}  // namespace mill
