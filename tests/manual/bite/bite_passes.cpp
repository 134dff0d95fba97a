#include "tests/manual/bite/bite_passes.h"
#include <cmath>
#include <vector>

namespace mill::verify {
namespace {
const std::vector<PassRow> pass_rows{{"B1", 210, 8, 5, 28, 0.2, 0, 0, 0, 0},
                                     {"B2", 210, 8, 5, 28, 0, 0, 0, 0, 0},
                                     {"B3", 420, 120, 100, 60, 0.35, 0, 0, 0, 0},
                                     {"B4", 300, 40, 30, 80, 0.30, 0, 0, 0, 0},
                                     {"B5", 250, 2, 1.5, 650, 0.06, 50, 80, 0.01, 0.20},
                                     {"B6", 250, 0.5, 0.35, 700, 0.05, 100, 150, 0.05, 0.15},
                                     {"B7", 100, 10, 9, 300, 0.10, 0, 0, 0, 0},
                                     {"B8", 250, 2, 1.5, 600, 0.06, 0, 0, 0, 0},
                                     {"B9", 420, 120, 115, 60, 0.35, 0, 0, 0, 0}};
}  // namespace

bite::RollBite bite_of(const PassRow &row)
{
  bite::RollBite b;
  b.roll_radius             = row.radius * 1e-3;
  b.roll.youngs_modulus     = 2.1e11;
  b.roll.poisson_ratio      = 0.28;
  b.strip.width             = 1;
  b.strip.entry_thickness   = row.entry * 1e-3;
  b.strip.exit_thickness    = row.exit * 1e-3;
  b.strip.entry_tension     = row.entry_tension * 1e6;
  b.strip.exit_tension      = row.exit_tension * 1e6;
  b.strip.flow_stress.k     = row.stress * 1e6;
  const double plane_strain = 2 / std::sqrt(3.);
  if (row.n > 0) {  // the uniaxial strain is 2/sqrt 3 of the thickness strain
    b.strip.flow_stress.law  = FlowStressLaw::swift;
    b.strip.flow_stress.k    = plane_strain * row.stress * 1e6 * std::pow(plane_strain, row.n);
    b.strip.flow_stress.eps0 = row.eps0 / plane_strain;
    b.strip.flow_stress.n    = row.n;
  }
  b.strip.friction.coefficient = row.friction;
  if (row.friction == 0) {
    b.strip.friction.law          = FrictionLaw::factor;
    b.strip.friction.entry_factor = b.strip.friction.exit_factor = 1;
  }
  return b;
}

bite::RollBite reference_pass(const std::string &name)
{
  for (const PassRow &row : pass_rows)
    if (row.name == name)
      return bite_of(row);
  return {};
}
}  // namespace mill::verify
