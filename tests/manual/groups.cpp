#include "tests/manual/groups.h"
#include "tests/manual/peer/peer.h"
#include "tests/manual/stand/response_cases.h"
#include <algorithm>

namespace mill::verify {
const std::vector<std::string> &names_of_long_form()
{
  static const std::vector<std::string> names{"strip-step42",
                                              "engine-agreement",
                                              "fe-mesh-order",
                                              "published-k",
                                              "roller-on-ring",
                                              "condensed-identity",
                                              "ring-mesh",
                                              "strip-flow-thick",
                                              "strip-flow-mesh",
                                              "strip-elastic-mesh",
                                              "strip-elastic-stiff",
                                              "strip-elastic-elastic-roll",
                                              "strip-elastic-balances",
                                              "strip-flow-derivative",
                                              "strip-flow-slab-ratio",
                                              "component-mesh",
                                              "component-assembly",
                                              "component-reach"};
  return names;
}

const std::vector<Group> &groups()
{
  static const std::vector<Group> all{{"ClosedForms", "contact", closed_forms},
                                      {"HalfSpace", "contact", half_space_cases},
                                      {"Section", "contact", section_cases},
                                      {"Solid", "contact", solid_cases},
                                      {"Friction", "contact", friction_cases},
                                      {"Nonlinear", "contact", nonlinear_cases},
                                      {"Roll", "contact", roll_cases},
                                      {"Bearing", "bearing", bearing_cases},
                                      {"Roller", "bearing", roller_cases},
                                      {"Ring", "bearing", ring_cases},
                                      {"OilFilm", "bearing", oil_film_cases},
                                      {"BearingMotion", "bearing", bearing_motion_cases},
                                      {"Slab", "bite", slab_cases},
                                      {"Inhomogeneous", "bite", inhomogeneous_cases},
                                      {"ElasticArc", "bite", elastic_arc_cases},
                                      {"StripFlow", "bite", strip_flow_cases},
                                      {"StripElastic", "bite", strip_elastic_cases},
                                      {"RollArc", "bite", roll_arc_cases},
                                      {"Mass", "masses", mass_cases},
                                      {"Component", "masses", component_cases},
                                      {"Housing", "masses", housing_cases},
                                      {"Response", "masses", response_cases},
                                      {"ChatterStand", "chatter", chatter_stand_cases},
                                      {"ChatterMotion", "chatter", chatter_motion_cases},
                                      {"ChatterSensitivity", "chatter", chatter_sensitivity_cases},
                                      {"ChatterTandem", "chatter", chatter_tandem_cases},
                                      {"Peer", "peer", peer_cases}};
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
