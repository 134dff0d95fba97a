// What fixed-step methods do to an undamped mode, row by row of the reference table.
#include "dynamics/solver_poles.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill::dynamics;

TEST(SolverPoles, EveryRowOfTheReferenceTable)
{
  const Tolerance closed = within(1e-6, "closed form");
  // A damping ratio is the logarithm of a modulus of one, divided by w h: rounding of the table's own root finding
  // leaves eps/(w h) <= 2e-16/2.9e-4 per operation; ten of them are 1e-11 absolute.
  const Tolerance root = within(1e-6, "cubic roots near the unit circle; absolute 1e-11 for rounding", 1e-5);
  for (const auto &row : reference("solver.poles").get<std::vector<std::vector<double>>>()) {
    const auto through = [&](const StepMethod method, const double rho = 1) {
      return seen_through(method, row[0], row[1], rho);
    };
    const Pole euler = through(StepMethod::implicit_euler), newmark = through(StepMethod::newmark);
    const Pole alpha8 = through(StepMethod::generalised_alpha, 0.8),
               alpha5 = through(StepMethod::generalised_alpha, 0.5);
    EXPECT_TRUE(near(euler.frequency, row[2], closed)) << row[0] << " Hz, " << row[1] << " s";
    EXPECT_TRUE(near(euler.damping, row[3], closed)) << row[0] << " Hz, " << row[1] << " s";
    EXPECT_TRUE(near(newmark.frequency, row[4], closed)) << row[0] << " Hz, " << row[1] << " s";
    EXPECT_LT(std::abs(newmark.damping), 1e-12) << "average acceleration keeps the energy";
    EXPECT_TRUE(near(alpha8.frequency, row[6], closed)) << row[0] << " Hz, " << row[1] << " s";
    EXPECT_TRUE(near(alpha8.damping, row[7], root)) << row[0] << " Hz, " << row[1] << " s";
    EXPECT_TRUE(near(alpha5.frequency, row[8], closed)) << row[0] << " Hz, " << row[1] << " s";
    EXPECT_TRUE(near(alpha5.damping, row[9], root)) << row[0] << " Hz, " << row[1] << " s";
  }
}

TEST(SolverPoles, ImplicitEulerInClosedForm)
{
  for (const double h : {1e-3, 1e-4, 1e-5}) {
    const double wh = 2 * M_PI * 600 * h, grow = std::log1p(wh * wh);
    const Pole seen = seen_through(StepMethod::implicit_euler, 600, h);
    EXPECT_TRUE(near(seen.frequency, std::atan(wh) / (2 * M_PI * h), within(1e-12, "closed form")));
    EXPECT_TRUE(near(seen.damping, grow / std::sqrt(4 * std::atan(wh) * std::atan(wh) + grow * grow),
                     within(1e-10, "closed form; log of a modulus near one loses eps/(w h)^2 = 2e-13")));
  }
}

TEST(SolverPoles, GeneralisedAlphaWithoutDissipationIsNewmark)
{
  const Pole alpha = seen_through(StepMethod::generalised_alpha, 600, 1e-4, 1);
  const Pole plain = seen_through(StepMethod::newmark, 600, 1e-4);
  EXPECT_TRUE(near(alpha.frequency, plain.frequency,
                   within(1e-7, "rho = 1 puts the third root on the circle: a "
                                "mode near it is known to the root of eps")));
}
