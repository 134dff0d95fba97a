#include "verify/verification.h"
#include <cmath>

namespace mill::verify {
Check relative(const std::string &quantity, const std::string &unit, const double result, const double reference,
               const double tolerance)
{
  return {quantity, unit, result, reference, tolerance};
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

std::vector<Case> all_cases()
{
  std::vector<Case> all;
  const auto add = [&](const std::string &family, std::vector<Case> cases) {
    for (Case &c : cases) {
      c.family = family;
      if (c.name.rfind("film-", 0) ==
          0)  // the bite under an oil film is part of both; families are parted by blanks
        c.family += " chatter";
      all.push_back(std::move(c));
    }
  };
  for (const auto cases :
       {closed_forms, half_space_cases, section_cases, solid_cases, friction_cases, nonlinear_cases, roll_cases})
    add("contact", cases());
  for (const auto cases : {bearing_cases, roller_cases, ring_cases, bearing_motion_cases})
    add("bearing", cases());
  for (const auto cases :
       {slab_cases, inhomogeneous_cases, elastic_arc_cases, strip_flow_cases, strip_elastic_cases, roll_arc_cases})
    add("bite", cases());
  for (const auto cases : {mass_cases, component_cases, housing_cases})
    add("masses", cases());
  for (const auto cases :
       {chatter_stand_cases, chatter_motion_cases, chatter_sensitivity_cases, chatter_tandem_cases})
    add("chatter", cases());
  return all;
}
}  // namespace mill::verify
