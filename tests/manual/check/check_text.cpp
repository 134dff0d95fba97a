#include "tests/manual/check/check_text.h"
#include "core/base/short_number.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::verify {
namespace {
// Below this the deviation of a check that passes is round-off, which differs from machine to machine.
constexpr double round_off = 1e-9;

// Seven digits, as a decimal fraction where that is readable.
std::string number(const double value)
{
  const double size = std::abs(value);
  if (!(size >= 1e-3 && size < 1e9))
    return short_number(value, 6);
  const int before = std::max(0, int(std::floor(std::log10(size))) + 1);
  return decimal_number(value, std::max(0, 7 - before));
}

std::string share(const double value)
{
  return std::abs(value) >= 1e-5 ? short_number(100 * value, 2) + " %" : short_number(value, 1);
}

double relative_deviation(const Check &c)
{
  return (c.result - c.reference) / std::abs(c.reference);
}

std::string deviation(const Check &c)
{
  if (!std::isfinite(c.result))
    return "-";
  switch (c.judged) {
  case Judged::at_least:
  case Judged::at_most:
    return "-";
  case Judged::absolute: {
    const double d    = c.result - c.reference;
    const bool hidden = passes(c) && std::abs(d) < round_off * std::max(1., std::abs(c.reference));
    return hidden ? "< 1e-9" : fmt::format("{:+.2g}", d);
  }
  case Judged::relative:
  case Judged::reported:
    break;
  }
  if (c.reference == 0)
    return "-";
  const double d = relative_deviation(c);
  return passes(c) && std::abs(d) < round_off ? "< 1e-9" : (d > 0 ? "+" : "") + share(d);
}

std::string tolerance(const Check &c)
{
  switch (c.judged) {
  case Judged::relative:
    return share(c.tolerance);
  case Judged::absolute:
    return c.tolerance == 0 ? "exact" : fmt::format("{} {}", number(c.tolerance), c.unit == "-" ? "" : c.unit);
  case Judged::at_least:
    return "at least";
  case Judged::at_most:
    return "at most";
  case Judged::reported:
    return "-";
  }
  return "";
}

std::string result(const Check &c)
{
  // A residual that is as small as it should be: only its order is a result.
  if (c.judged == Judged::at_most && std::abs(c.reference) <= round_off && passes(c) && !c.known)
    return "below " + number(c.reference);
  if (c.judged == Judged::absolute && c.reference == 0 && passes(c) && std::abs(c.result) < round_off)
    return "0";
  return number(c.result);
}

std::string trimmed(std::string text)
{
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return text;
}

std::string verdict_text(const Verdict verdict)
{
  switch (verdict) {
  case Verdict::pass:
    return "pass";
  case Verdict::fail:
    return "FAIL";
  case Verdict::known_deviation:
    return "known deviation";
  case Verdict::reported:
    return "reported";
  }
  return "";
}

std::string moved(const Check &c)
{
  if (passes(c))
    return "";
  Check asked = c;
  asked.known.reset();
  if (passes(asked))
    return "the asked reference is reached now: it is an ordinary check again";
  return fmt::format("recorded was {} with a spread of {}", number(c.known->result), number(c.known->spread));
}
}  // namespace

CheckText check_text(const Check &c)
{
  return {c.quantity,
          result(c),
          c.unit,
          number(c.reference),
          deviation(c),
          trimmed(tolerance(c)),
          verdict_text(verdict(c))};
}

std::string table_cell(std::string text)
{
  for (std::size_t position = 0; (position = text.find('|', position)) != std::string::npos; position += 2)
    text.insert(position, "\\");
  return text;
}

std::vector<std::string> cells_of_line(const std::string &line)
{
  std::vector<std::string> cells;
  if (line.rfind("| ", 0) != 0)
    return cells;
  for (std::size_t begin = 2, end; (end = line.find(" |", begin)) != std::string::npos; begin = end + 3)
    cells.push_back(line.substr(begin, end - begin));
  return cells;
}

std::vector<KnownText> known_deviations(const std::vector<Check> &checks)
{
  std::vector<KnownText> known;
  for (const Check &c : checks)
    if (c.known)
      known.push_back({check_text(c), c.known->cause, c.known->remedy, moved(c)});
  return known;
}
}  // namespace mill::verify
