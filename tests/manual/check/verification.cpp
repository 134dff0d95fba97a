#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>

namespace mill::verify {
Check relative(const std::string &quantity, const std::string &unit, const double result, const double reference,
               const double tolerance)
{
  return {quantity, unit, result, reference, tolerance};
}

Check absolute(const std::string &quantity, const std::string &unit, const double result, const double reference,
               const double tolerance)
{
  return {quantity, unit, result, reference, tolerance, Judged::absolute};
}

Check within(const std::string &quantity, const double result, const double low, const double high)
{
  return {quantity, "-", result, 0.5 * (low + high), 0.5 * (high - low), Judged::absolute};
}

Check at_most(const std::string &quantity, const std::string &unit, const double result, const double limit)
{
  return {quantity, unit, result, limit, 0, Judged::at_most};
}

Check reported(const std::string &quantity, const std::string &unit, const double result, const double reference)
{
  return {quantity, unit, result, reference, 0, Judged::reported};
}

Check known_deviation(Check asked, const KnownDeviation &known)
{
  asked.known = known;
  return asked;
}

namespace {
bool within_bound(const Check &c)
{
  switch (c.judged) {
  case Judged::relative:
    return std::abs(c.result - c.reference) <= c.tolerance * std::abs(c.reference);
  case Judged::absolute:
    return std::abs(c.result - c.reference) <= c.tolerance;
  case Judged::at_least:
    return c.result >= c.reference;
  case Judged::at_most:
    return c.result <= c.reference;
  case Judged::reported:
    return !std::isnan(c.result);
  }
  return false;
}
}  // namespace

Verdict verdict(const Check &c)
{
  const bool within = within_bound(c);
  if (c.known) {
    const bool as_recorded = std::abs(c.result - c.known->result) <= c.known->spread;
    return !within && as_recorded ? Verdict::known_deviation : Verdict::fail;
  }
  if (!within)
    return Verdict::fail;
  return c.judged == Judged::reported ? Verdict::reported : Verdict::pass;
}

bool passes(const Check &c)
{
  return verdict(c) != Verdict::fail;
}

Tally tally(const std::vector<Check> &checks)
{
  Tally t;
  for (const Check &c : checks)
    switch (verdict(c)) {
    case Verdict::pass:
      ++t.passed;
      break;
    case Verdict::fail:
      ++t.failed;
      break;
    case Verdict::known_deviation:
      ++t.known;
      break;
    case Verdict::reported:
      ++t.reported;
      break;
    }
  return t;
}

double allowed_change(const Check &c)
{
  if (c.known)
    return c.known->spread;
  switch (c.judged) {
  case Judged::relative:
    return c.tolerance * std::abs(c.reference);
  case Judged::absolute:
    return c.tolerance;
  case Judged::at_least:
  case Judged::at_most:
    return std::max(0.1 * std::abs(c.reference), 0.01 * std::abs(c.result));
  case Judged::reported:
    return 0.01 * std::max(std::abs(c.reference), std::abs(c.result));
  }
  return 0;
}

const std::vector<Kind> &kinds()
{
  static const std::vector<Kind> all{
      {"unit", "a closed form or kernel in isolation"},
      {"verification", "the whole numerical chain against an exact reference or an independent method"},
      {"benchmark", "a comparison with published numbers or with another program"},
      {"regression", "values computed beforehand by the program that belongs to the specification: another "
                     "code of the same equations, no measurement and no publication"}};
  return all;
}
}  // namespace mill::verify
