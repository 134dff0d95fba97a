// The six-mass chain: matrices, static state, what the meaning of the force changes.
#include "core/base/errors.h"
#include "dynamics/response/mill_model.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

const Tolerance one_solve = within(1e-8, "one linear solve in double precision, condition of K about 1e3");

TEST(MillModel, StaticDisplacementPerNewtonOfBiteForce)
{
  const auto with_bite = mill_model(published_stand(), settings(ForceMeaning::published, 0.01));
  EXPECT_TRUE(near(static_displacement(with_bite), reference_vector("static.K4_on"), one_solve));
  const auto without = mill_model(published_stand(), settings(ForceMeaning::measured, 0.01));
  EXPECT_TRUE(near(static_displacement(without), reference_vector("static.K4_zero"), one_solve));
}

TEST(MillModel, MillModulusIsTheGapPerNewton)
{
  const double modulus = mill_modulus(published_stand());
  EXPECT_TRUE(near(modulus, reference("static.mill_modulus"), one_solve));
  const Eigen::VectorXd y =
      static_displacement(mill_model(published_stand(), settings(ForceMeaning::measured, 0)));
  EXPECT_TRUE(near(1 / (y[upper_work_roll] - y[lower_work_roll]), modulus, one_solve));
}

TEST(MillModel, TheMeaningOfTheForceDecidesTheSpringInTheBite)
{
  auto stand                = published_stand();
  stand.C.value             = 1e6;
  const auto bite_stiffness = [&](const ForceMeaning meaning) {
    return -mill_model(stand, settings(meaning, 0)).K(2, 3);
  };
  const auto bite_damping = [&](const ForceMeaning meaning) {
    return -mill_model(stand, settings(meaning, 0)).C(2, 3);
  };
  EXPECT_EQ(bite_stiffness(ForceMeaning::measured), 0);
  EXPECT_EQ(bite_stiffness(ForceMeaning::disturbance), 1.91141e11);
  EXPECT_EQ(bite_stiffness(ForceMeaning::published), 1.91141e11);
  EXPECT_EQ(bite_damping(ForceMeaning::measured), 0);
  EXPECT_EQ(bite_damping(ForceMeaning::disturbance), 1e6);
  EXPECT_EQ(bite_damping(ForceMeaning::published), 1e6);
  stand.C.value = not_given;
  EXPECT_EQ(bite_damping(ForceMeaning::disturbance), 0) << "no damper given";
}

TEST(MillModel, LoadCellShowsTheMeanForceUnlessTheBiteTakesItsShare)
{
  const auto share = [](const ForceMeaning meaning) {
    return mill_model(published_stand(), settings(meaning, 0)).load_cell_share;
  };
  EXPECT_EQ(share(ForceMeaning::measured), 1);
  EXPECT_EQ(share(ForceMeaning::disturbance), 1);
  const double K7 = 6.8789e9;
  EXPECT_TRUE(
      near(share(ForceMeaning::published), -K7 * reference_vector("static.K4_on")[lower_frame], one_solve));
  const auto measured = mill_model(published_stand(), settings(ForceMeaning::measured, 0));
  EXPECT_TRUE(near(measured.load_cell.dot(static_displacement(measured)), 1,
                   within(1e-12, "equilibrium: without K4 the frame carries the bite force whole")));
}

TEST(MillModel, ClosedFrameCarriesTheForceInItsPosts)
{
  auto closed             = settings(ForceMeaning::measured, 0.01);
  closed.frame            = FrameForm::closed;
  const auto model        = mill_model(published_stand(), closed);
  const Eigen::VectorXd y = static_displacement(model);
  EXPECT_TRUE(near(y[lower_frame], 0, within(1e-20, "m: no force on the foundation, rounding of 1e-11 m", 1)));
  EXPECT_TRUE(near(model.load_cell.dot(y), 1, within(1e-12, "equilibrium of the upper half")));
}

TEST(MillModel, DampingMatrixOfEveryParameterSetIsThatOfTheReference)
{
  for (const char *name : {"P1", "P2", "P3", "P4", "Q1", "R1", "R2", "R3"}) {
    const auto set = parameter_set(name);
    const auto rows =
        reference(std::string("regression.") + name + ".system").at("C").get<std::vector<std::vector<double>>>();
    const Eigen::MatrixXd C = mill_model(set.stand, set.dynamics).C;
    double largest          = 0;
    for (const auto &row : rows)
      for (const double entry : row)
        largest = std::max(largest, std::abs(entry));
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        EXPECT_TRUE(
            near(C(i, j), rows[std::size_t(i)][std::size_t(j)],
                 within(1e-10, "rounding of one 6 x 6 eigenproblem, relative to the largest entry", largest)))
            << name << " C(" << i << "," << j << ")";
  }
}

TEST(MillModel, AMechanismHasNoStaticState)
{
  auto loose       = published_stand();
  loose.K[6].value = 0;  // nothing holds the lower half
  EXPECT_THROW(static_displacement(mill_model(loose, settings(ForceMeaning::measured, 0.01))), SolverError);
}
