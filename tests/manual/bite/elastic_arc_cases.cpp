#include "core/base/errors.h"
#include "tests/manual/bite/karman_models.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include <cmath>

namespace mill::verify {
namespace {
using namespace bite;

RollBite uncapped(const int i)
{
  RollBite b                   = numbered(i);
  b.strip.friction.shear_limit = not_given;
  return b;
}

std::vector<Check> elastic_arcs()
{
  std::vector<Check> checks;
  const struct {
    int pass;
    double F, peak, exit, entry;
  } table[] = {{5, 7568.72, 733.3, -1.160, 11.453}, {6, 7971.13, 1489.6, -1.862, 6.675}};
  for (const auto &row : table) {
    const std::string id = "B" + std::to_string(row.pass);
    for (const int points : {100, 200, 400}) {
      KarmanOptions options;
      options.arc_points      = points;
      options.derivatives     = false;
      const BiteState s       = solve_karman(uncapped(row.pass), Theory::karman, Arc::elastic, nullptr, options);
      const std::string where = id + ", " + std::to_string(points) + " points";
      checks.push_back(relative(where + ", force", "N", s.force, row.F, points == 100 ? 2e-3 : 5e-4));
      if (points == 400) {
        checks.push_back(relative(where + ", peak pressure", "MPa", s.peak_pressure / MPa, row.peak, 1e-3));
        checks.push_back(
            {where + ", exit of the plastic arc", "mm", s.exit_position / mm, row.exit, 3e-3, Judged::absolute});
        checks.push_back(
            {where + ", entry of the plastic arc", "mm", s.arc_length / mm, row.entry, 3e-3, Judged::absolute});
      }
    }
  }
  return checks;
}

std::vector<Check> without_elastic_zones()
{
  std::vector<Check> checks;
  for (const int points : {200, 400}) {
    RollBite b             = uncapped(6);
    b.strip.youngs_modulus = INFINITY;
    KarmanOptions options;
    options.arc_points = points;
    double refused     = 0;
    try {
      solve_karman(b, Theory::karman, Arc::elastic, nullptr, options);
    } catch (const InputError &) {
      refused = 1;
    }
    checks.push_back({std::to_string(points) + " points: refused in words", "-", refused, 1, 0});
  }
  // A strip that is a thousand times too stiff ends almost in a step: reported, or solved with the zone resolved.
  RollBite b             = uncapped(6);
  b.strip.youngs_modulus = 2.1e17;
  double refused         = 0;
  try {
    solve_karman(b, Theory::karman, Arc::elastic, nullptr, KarmanOptions{});
  } catch (const SolverError &) {
    refused = 1;
  }
  checks.push_back({"zone of a strip a million times as stiff: reported as unresolved", "-", refused, 1, 0});
  return checks;
}

/// Solution with another strip modulus goes to the circular one where the roll is stiff.
std::vector<Check> stiff_roll()
{
  RollBite b            = uncapped(5);
  b.roll.youngs_modulus = 2.1e17;
  std::vector<Check> checks;
  KarmanOptions options;
  options.arc_points   = 400;
  const BiteState s    = solve_karman(b, Theory::karman, Arc::elastic, nullptr, options);
  const double plastic = force_on_parabola(5, false);
  // Both elastic zones in closed form on the parabola h = h2 + x^2/R: straight pressure in h.
  const double E = 2.1e11 / (1 - 0.28 * 0.28), R = 0.25, h1 = 2 * mm, h2 = 1.5 * mm;
  const double p_exit = s.exit_flow_stress - 80 * MPa, p_entry = s.entry_flow_stress - 50 * MPa;
  const double exit = 2.0 / 3 * p_exit * std::sqrt(R * h2 * p_exit / E);
  const double x1 = std::sqrt(R * (h1 - h2)), x2 = std::sqrt(R * (h1 - h2 + h1 * p_entry / E));
  const double entry =
      (p_entry + E * (h1 - h2) / h1) * (x2 - x1) - E / h1 * (x2 * x2 * x2 - x1 * x1 * x1) / (3 * R);
  checks.push_back(relative("B5, force", "N", s.force, plastic + (exit + entry) * mm, 1e-4));
  checks.push_back(relative("B5, dF/dh2 with the arc following against the arc held", "N/mm",
                            s.force_by_exit_following * mm, by(s.force_by, Input::exit_thickness) * mm, 2e-3));
  return checks;
}
}  // namespace

std::vector<Case> elastic_arc_cases()
{
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const char *problem, const char *source,
                       const char *reason, const std::function<std::vector<Check>()> &run) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("elastic-arc", "regression",
      "BI-18: rolls of any shape as half planes, elastic zones of the strip, homogeneous slices with small "
      "angles, uncapped Coulomb friction; Newton on all pressures with 100, 200 and 400 graded points",
      "relaxation with 1600 even points by an independent program: 7566.97, 7568.40, 7568.72 N (B5) and 7979.36, "
      "7972.79, 7971.13 N (B6) at 400, 800, 1600 points",
      "0.2 % asked; 0.05 % from 200 points on, the grid error of both sides; places to 3 um, a fifth of the "
      "reference's spacing",
      elastic_arcs);
  add("elastic-arc-refused", "unit",
      "BI-19: without elastic zones the pressure ends in a step, under which the arc has no limit: it is refused "
      "whatever the grid",
      "no number: 9411 and 9740 N with 600 and 1200 points, still moving, is what relaxation gives", "exact",
      without_elastic_zones);
  add("elastic-arc-stiff", "verification",
      "rolls a million times as stiff: the elastic arc must give the slices on the parabola plus both elastic "
      "zones, whose pressure is then known in closed form",
      "homogeneous slices by the integration of order 12; zones integrated by hand",
      "1e-4: straight pressure between 400 points", stiff_roll);
  return cases;
}
}  // namespace mill::verify
