#include "core/case/bearing_catalogue.h"
#include "core/model/bearing_ratings.h"
#include "reduce/bearing/rating_life.h"
#include "reduce/bearing/ratings.h"
#include "tests/manual/bearing/bearing_models.h"
#include "tests/manual/check/units.h"
#include <cmath>
#include <fmt/format.h>

// Life by the standards, and rollers from published ratings.
namespace mill::verify {
namespace {
std::vector<Check> rating_life()
{
  std::vector<Check> checks;
  // C of the rating table (case fc-ratings), printed in kN; 1e6 (C/P)^(10/3).
  for (const auto &[diameter, C] : {std::pair(20.0, 1416.0), std::pair(21.5, 1552.0), std::pair(23.0, 1690.0)})
    for (const double P : {500.0, 1000.0}) {
      RollerBearing b   = bearing_266();
      b.roller_diameter = diameter * mm;
      checks.push_back(relative(fmt::format("L10, roller {:g} mm, {:g} kN", diameter, P), "1e6 rev",
                                bearing::basic_life(bearing::ratings(b).dynamic, P * kN) / 1e6,
                                std::pow(C / P, 10. / 3), 5e-3));
    }
  for (const double F : {500.0, 1000.0}) {
    const RollerBearing b = bearing_266();
    const double C        = bearing::ratings(b).dynamic;
    const auto state      = bearing::BearingAssembly(bearing::rigid_model(b)).solve(bearing::radial_drive(F * kN));
    const auto life       = bearing::reference_life(b, state, C, bearing::EndFactor::none);
    checks.push_back(relative(fmt::format("L10r of even slices, {:g} kN", F), "1e6 rev", life.life / 1e6,
                              0.9854 * std::pow(C / (0.83 * F * kN), 4), 5e-3));
    checks.push_back(reported(fmt::format("L10r with the factor of the ends, {:g} kN", F), "1e6 rev",
                              bearing::reference_life(b, state, C).life / 1e6,
                              bearing::basic_life(C, F * kN) / 1e6));
  }
  return checks;
}

std::vector<Check> designation_rollers()
{
  std::vector<Check> checks;
  RollerBearing b   = bearing_266(19.66);
  const Ratings has = ratings(b);
  b.dynamic_rating  = has.dynamic;
  b.static_rating   = has.static_rating;
  double diameter = 0, length = 0;
  for (const RollerCandidate &c : roller_candidates(b))
    if (c.rollers_per_row == 39) {
      diameter = c.roller_diameter;
      length   = c.roller_length;
    }
  checks.push_back(relative("roller diameter of the candidate with 39 rollers", "mm", diameter / mm, 21.5, 1e-10));
  checks.push_back(relative("roller length of the same", "mm", length / mm, 33.4, 1e-10));
  for (const CatalogueBearing &entry : shipped_catalogue()) {
    if (std::isnan(entry.dynamic_rating))
      continue;
    RollerBearing c;
    c.name             = entry.designation;
    c.type             = entry.type;
    c.bore             = entry.bore;
    c.outside_diameter = entry.outside_diameter;
    c.width            = entry.width;
    c.rows             = entry.rows;
    c.dynamic_rating   = entry.dynamic_rating;
    c.static_rating    = entry.static_rating;
    c.cup_angle        = entry.type == BearingType::four_row_tapered ? 15 * degree : 0;
    const auto all     = roller_candidates(c);
    checks.push_back({"candidates of " + entry.designation, "-", double(all.size()), 1, 0, Judged::at_least});
    if (all.empty())
      continue;
    const RollerCandidate &one = all.front();
    checks.push_back(
        within("roller diameter over the wall between bore and outside diameter, " + entry.designation,
               one.roller_diameter / ((c.outside_diameter - c.bore) / 2), 0.3, 0.7));
    checks.push_back(within("roller length over the width of a row, " + entry.designation,
                            one.roller_length * std::cos(one.cup_angle) / (c.width / c.rows), 0.5, 1));
  }
  return checks;
}
}  // namespace

std::vector<Case> life_cases()
{
  std::vector<Case> cases;
  cases.push_back({"rating-life", "verification",
                   "Basic life of the four-row bearing at two loads, rollers of 20, 21.5 and 23 mm; and its "
                   "reference life by 41 "
                   "slices of 156 solved rollers, even slices, no clearance, without the factor of the ends.",
                   "ISO 281: 1e6 (C/P)^(10/3) with the tabulated C; ISO/TS 16281: Stribeck's distribution gives "
                   "1e6 (C/(0.83 F))^4, and 0.9854 of it with the standard's factors 0.378 and 0.364 rounded to "
                   "three digits",
                   "0.5 %: a table of four digits to the power 10/3", rating_life});
  cases.push_back({"designation-rollers", "verification",
                   "Rollers from the ratings alone: those of the demo bearing among the candidates, and for every "
                   "bearing of the "
                   "catalogue with ratings rollers that fit between its rings.",
                   "the drawing of the demo bearing; bore, outside diameter and width of the catalogue",
                   "rounding; a roller takes a third to two thirds of the wall and at least half of its row in "
                   "any roll-neck bearing",
                   designation_rollers});
  return cases;
}
}  // namespace mill::verify
