#include "verify/verification.h"
#include "verify/peer/peer.h"
#include "verify/stand/response_cases.h"
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
      {"unit",         "a closed form or kernel in isolation"                                           },
      {"verification", "the whole numerical chain against an exact reference or an independent method"  },
      {"benchmark",    "a comparison with published numbers or with another program"                    },
      {"regression",   "values computed beforehand by the program that belongs to the specification: another "
                     "code of the same equations, no measurement and no publication"}
  };
  return all;
}

const std::vector<std::string> &names_of_long_form()
{
  static const std::vector<std::string> names{"strip-step42",       "engine-agreement",    "fe-mesh-order",
                                              "published-k",        "roller-on-ring",      "condensed-identity",
                                              "ring-mesh",          "strip-flow-thick",    "strip-flow-mesh",
                                              "strip-elastic-mesh", "strip-elastic-stiff", "component-mesh"};
  return names;
}

const std::vector<Group> &groups()
{
  static const std::vector<Group> all{
      {"ClosedForms",        "contact", closed_forms             },
      {"HalfSpace",          "contact", half_space_cases         },
      {"Section",            "contact", section_cases            },
      {"Solid",              "contact", solid_cases              },
      {"Friction",           "contact", friction_cases           },
      {"Nonlinear",          "contact", nonlinear_cases          },
      {"Roll",               "contact", roll_cases               },
      {"Bearing",            "bearing", bearing_cases            },
      {"Roller",             "bearing", roller_cases             },
      {"Ring",               "bearing", ring_cases               },
      {"OilFilm",            "bearing", oil_film_cases           },
      {"BearingMotion",      "bearing", bearing_motion_cases     },
      {"Slab",               "bite",    slab_cases               },
      {"Inhomogeneous",      "bite",    inhomogeneous_cases      },
      {"ElasticArc",         "bite",    elastic_arc_cases        },
      {"StripFlow",          "bite",    strip_flow_cases         },
      {"StripElastic",       "bite",    strip_elastic_cases      },
      {"RollArc",            "bite",    roll_arc_cases           },
      {"Mass",               "masses",  mass_cases               },
      {"Component",          "masses",  component_cases          },
      {"Housing",            "masses",  housing_cases            },
      {"Response",           "masses",  response_cases           },
      {"ChatterStand",       "chatter", chatter_stand_cases      },
      {"ChatterMotion",      "chatter", chatter_motion_cases     },
      {"ChatterSensitivity", "chatter", chatter_sensitivity_cases},
      {"ChatterTandem",      "chatter", chatter_tandem_cases     },
      {"Peer",               "peer",    peer_cases               }
  };
  return all;
}

std::vector<Case> cases_of(const Group &group)
{
  const std::vector<std::string> &long_form = names_of_long_form();
  std::vector<Case> cases                   = group.cases();
  for (Case &c : cases) {
    c.family    = group.family;
    c.long_form = std::count(long_form.begin(), long_form.end(), c.name) > 0;
    // The bite under an oil film is part of both; families are parted by blanks.
    if (c.name.rfind("film-", 0) == 0)
      c.family += " chatter";
  }
  return cases;
}

std::vector<Case> all_cases()
{
  std::vector<Case> all;
  for (const Group &group : groups())
    for (Case &c : cases_of(group))
      all.push_back(std::move(c));
  return all;
}
}  // namespace mill::verify
