#include "twin/records/record_units.h"
#include "core/base/units.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace mill::twin {
namespace {
constexpr double inch  = 0.0254;           // m, exactly (international yard and pound agreement, 1959)
constexpr double foot  = 0.3048;           // m
constexpr double pound = 4.4482216152605;  // N, 0.45359237 kg under standard gravity

struct RecordUnit {
  const char *spelling;
  const char *si;
  double factor;
  Quantity quantity;
};

// Units that a record may have and a case file does not.
constexpr RecordUnit record_units[] = {
    {"V", "V", 1, Quantity::voltage},
    {"mV", "V", 1e-3, Quantity::voltage},
    {"uV", "V", 1e-6, Quantity::voltage},
    {"mm/s2", "m/s2", 1e-3, Quantity::acceleration},
    {"cm/s2", "m/s2", 1e-2, Quantity::acceleration},
    {"mg", "m/s2", 9.80665e-3, Quantity::acceleration},
    {"in/s2", "m/s2", inch, Quantity::acceleration},
    {"ft/s2", "m/s2", foot, Quantity::acceleration},
    {"cm/s", "m/s", 1e-2, Quantity::velocity},
    {"um/s", "m/s", 1e-6, Quantity::velocity},
    {"km/h", "m/s", 1 / 3.6, Quantity::velocity},
    {"in/s", "m/s", inch, Quantity::velocity},
    {"ft/s", "m/s", foot, Quantity::velocity},
    {"ft/min", "m/s", foot / 60, Quantity::velocity},
    {"cm", "m", 1e-2, Quantity::displacement},
    {"nm", "m", 1e-9, Quantity::displacement},
    {"in", "m", inch, Quantity::displacement},
    {"ft", "m", foot, Quantity::displacement},
    {"mil", "m", 1e-3 * inch, Quantity::displacement},
    {"lbf", "N", pound, Quantity::force},
    {"kip", "N", 1e3 * pound, Quantity::force},
    {"psi", "Pa", pound / (inch * inch), Quantity::other},
    {"ksi", "Pa", 1e3 * pound / (inch * inch), Quantity::other},
    {"mbar", "Pa", 100, Quantity::other},
    {"degC", "degC", 1, Quantity::other},
};

// Spellings of data loggers, each for one of the units above or of a case file.
constexpr std::pair<const char *, const char *> spellings[] = {
    {"M/S2", "m/s2"},     {"m/s/s", "m/s2"},   {"m/sec2", "m/s2"},   {"m/sec/sec", "m/s2"}, {"G", "g"},
    {"gn", "g"},          {"g's", "g"},        {"gs", "g"},          {"mm/sec", "mm/s"},    {"m/sec", "m/s"},
    {"mpm", "m/min"},     {"ips", "in/s"},     {"in/sec", "in/s"},   {"inch/s", "in/s"},    {"inch/sec", "in/s"},
    {"in/sec2", "in/s2"}, {"in/s/s", "in/s2"}, {"inch/s2", "in/s2"}, {"fps", "ft/s"},       {"ft/sec", "ft/s"},
    {"ft/sec2", "ft/s2"}, {"fpm", "ft/min"},   {"inch", "in"},       {"inches", "in"},      {"feet", "ft"},
    {"foot", "ft"},       {"mils", "mil"},     {"thou", "mil"},      {"micron", "um"},      {"microns", "um"},
    {"KN", "kN"},         {"kn", "kN"},        {"newton", "N"},      {"Newton", "N"},       {"lb", "lbf"},
    {"lbs", "lbf"},       {"klbf", "kip"},     {"kips", "kip"},      {"PSI", "psi"},        {"Volt", "V"},
    {"volt", "V"},        {"volts", "V"},      {"Volts", "V"},       {"Bar", "bar"},
};

// Exponents and signs as an ASCII keyboard has them; "pk" and "rms" behind a unit say how it was measured.
std::string plain_spelling(std::string text)
{
  static const std::array<std::pair<std::string_view, std::string_view>, 8> plain{{{"\u00b2", "2"},
                                                                                   {"\u00b3", "3"},
                                                                                   {"**", ""},
                                                                                   {"^", ""},
                                                                                   {"\u00b5", "u"},
                                                                                   {"\u03bc", "u"},
                                                                                   {"\u00b0", "deg"},
                                                                                   {"\u2103", "degC"}}};
  for (const auto &[from, to] : plain)
    for (std::size_t position = text.find(from); position != std::string::npos;
         position             = text.find(from, position + to.size()))
      text.replace(position, from.size(), to);
  for (const auto &[from, to] : spellings)
    if (text == from)
      return to;
  return text;
}

bool is_speed_name(const std::string &name)
{
  const auto known = choice_named<KnownChannel>(name);
  return known && *known != KnownChannel::force && *known != KnownChannel::load_cell;
}

Quantity velocity_or_speed(const std::string &name)
{
  return is_speed_name(name) ? Quantity::speed : Quantity::velocity;
}

bool is_number(const std::string_view text)
{
  return !text.empty() && std::all_of(text.begin(), text.end(), [](const char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == ',' || c == '-' || c == '+';
  });
}

// Symbols that units are made of, with the prefixes that they take.
bool is_unit_symbol(std::string_view text)
{
  static const std::array<const char *, 56> symbols{
      "m",   "g",  "s",   "A",    "K",   "V",   "W",  "N",    "J",    "Pa",  "Hz",  "bar", "l",   "L",
      "t",   "C",  "F",   "Ohm",  "T",   "B",   "dB", "rad",  "deg",  "min", "h",   "d",   "U",   "rpm",
      "in",  "ft", "mil", "lb",   "lbf", "psi", "%",  "degC", "degF", "VA",  "var", "Ah",  "Wh",  "Nm",
      "mol", "lm", "lx",  "inch", "gal", "hp",  "PS", "rev",  "Umdr", "sec", "std", "Std", "1/s", "EU"};
  const auto is_symbol = [&](const std::string_view word) {
    return std::any_of(symbols.begin(), symbols.end(), [&](const char *symbol) { return word == symbol; });
  };
  while (!text.empty() && (is_number(text.substr(text.size() - 1))))
    text.remove_suffix(1);  // exponent
  if (is_symbol(text))
    return true;
  return text.size() > 1 && std::string_view("kMGmunpcdh").find(text.front()) != std::string_view::npos &&
         is_symbol(text.substr(1));
}
}  // namespace

const char *name_of(const Quantity quantity)
{
  switch (quantity) {
  case Quantity::acceleration:
    return "acceleration";
  case Quantity::velocity:
    return "velocity";
  case Quantity::displacement:
    return "displacement";
  case Quantity::force:
    return "force";
  case Quantity::speed:
    return "speed";
  case Quantity::voltage:
    return "voltage";
  case Quantity::other:
    return "quantity without a known unit";
  }
  return "";
}

std::string trimmed_cell(std::string_view text)
{
  const auto is_blank = [](const char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"' || c == '\0'; };
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return std::string(text);
}

std::string lower(const std::string_view text)
{
  std::string result(text);
  for (char &c : result)
    c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return result;
}

ColumnUnit unit_of_column(const std::string &text, const std::string &name)
{
  const std::string written = trimmed_cell(text), spelling = plain_spelling(written);
  for (const RecordUnit &u : record_units)
    if (spelling == u.spelling)
      return {u.si, u.factor, u.quantity == Quantity::velocity ? velocity_or_speed(name) : u.quantity, true};
  const Unit *known_unit = spelling.empty() ? nullptr : find_unit(spelling);
  if (!known_unit)
    return {written.empty() ? "1" : written, 1, Quantity::other, false};
  const double factor = known_unit->multiply / known_unit->divide;
  const auto is_like  = [&](const char *symbol) { return known_unit->dimension == unit(symbol).dimension; };
  if (is_like("m/s2"))
    return {"m/s2", factor, Quantity::acceleration, true};
  if (is_like("N"))
    return {"N", factor, Quantity::force, true};
  if (is_like("m/s"))
    return {"m/s", factor, velocity_or_speed(name), true};
  if (is_like("m"))
    return {"m", factor, Quantity::displacement, true};
  if (is_like("Pa"))
    return {"Pa", factor, Quantity::other, true};
  return {known_unit->symbol, 1, Quantity::other, true};
}

bool looks_like_unit(const std::string_view text)
{
  const std::string spelling = plain_spelling(trimmed_cell(text));
  bool any                   = false;
  std::size_t from           = 0;
  while (from <= spelling.size()) {
    const std::size_t end       = std::min(spelling.find_first_of("/*.- ()\u00b7", from), spelling.size());
    const std::string_view part = std::string_view(spelling).substr(from, end - from);
    if (!part.empty() && !is_number(part)) {
      if (!is_unit_symbol(part))
        return false;
      any = true;
    }
    from = end + 1;
  }
  return any;
}

double seconds_per(const std::string &text)
{
  static const std::array<std::pair<const char *, double>, 26> units{{{"s", 1},
                                                                      {"sec", 1},
                                                                      {"secs", 1},
                                                                      {"second", 1},
                                                                      {"seconds", 1},
                                                                      {"sekunde", 1},
                                                                      {"sekunden", 1},
                                                                      {"ms", 1e-3},
                                                                      {"msec", 1e-3},
                                                                      {"millisecond", 1e-3},
                                                                      {"milliseconds", 1e-3},
                                                                      {"us", 1e-6},
                                                                      {"\u00b5s", 1e-6},
                                                                      {"\u03bcs", 1e-6},
                                                                      {"usec", 1e-6},
                                                                      {"microseconds", 1e-6},
                                                                      {"ns", 1e-9},
                                                                      {"nanoseconds", 1e-9},
                                                                      {"min", 60},
                                                                      {"minuten", 60},
                                                                      {"minutes", 60},
                                                                      {"h", 3600},
                                                                      {"std", 3600},
                                                                      {"hours", 3600},
                                                                      {"hour", 3600},
                                                                      {"stunden", 3600}}};
  const std::string spelling = lower(trimmed_cell(text));
  for (const auto &[name, seconds] : units)
    if (spelling == name)
      return seconds;
  return 0;
}
}  // namespace mill::twin
