// A case has one damping ratio; ratios that were calibrated mode by mode go into it as their geometric mean.
#include "app/twin/calibrate/calibrated_case.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;

namespace {
twin::Calibrated ratio(const std::string &name, const double change, const bool taken)
{
  twin::Calibrated unknown;
  unknown.name  = name;
  unknown.kept  = change;
  unknown.taken = taken;
  return unknown;
}

double damping_with(const std::vector<twin::Calibrated> &unknowns)
{
  Case lumped;
  Lumped spec;
  spec.dynamics.modal_damping = 0.01;
  lumped.spec                 = spec;
  twin::Calibration result;
  result.unknowns = unknowns;
  result.modes.resize(4);
  const Case written = with_damping(lumped, result);
  return std::get<Lumped>(written.spec).dynamics.modal_damping;
}

const char *digits = "one exponential, rounded";
}  // namespace

TEST(CalibratedDamping, OneRatioOfAllModesIsTaken)
{
  EXPECT_TRUE(near(damping_with({ratio("zeta", std::log(1.5), true)}), 0.015, within(1e-12, digits)));
  EXPECT_TRUE(near(damping_with({ratio("zeta", std::log(1.5), false)}), 0.01, within(1e-12, digits)));
}

TEST(CalibratedDamping, RatiosOfSingleModesAreAveragedOverAllModes)
{
  // factors 4, 1, 4 and 1, of which the last is that of a mode that was not freed
  EXPECT_TRUE(near(damping_with({ratio("zeta1", std::log(4.), true), ratio("zeta2", 0, true),
                                 ratio("zeta3", std::log(4.), true)}),
                   0.02, within(1e-12, digits)));
  EXPECT_TRUE(near(damping_with({ratio("zeta2", std::log(16.), true)}), 0.02, within(1e-12, digits)));
}
