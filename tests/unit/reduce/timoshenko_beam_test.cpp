// Beam elements against closed forms, and what a roll may not look like.
#include "reduce/chain/roll_body.h"
#include "reduce/chain/timoshenko_beam.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/Dense>
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
const double endless = std::numeric_limits<double>::infinity();
}

TEST(SymmetricBeam, RigidMotionIsFreeAndTheMassIsTheBeams)
{
  const SymmetricBeam beam = symmetric_beam({{0.7, 5, {1e9, 5e9}, 100}, {0.4, 3, {1e8, 2e9}, 40}});
  ASSERT_EQ(beam.z.size(), 9);
  EXPECT_TRUE(
      near(beam.mass.sum(), 2 * (0.7 * 100 + 0.4 * 40), within(1e-14, "sum of the elements, both halves")));
  EXPECT_TRUE(near(beam.z[8], 1.1, within(1e-14, "lengths added up")));
  EXPECT_LT((beam.K * Eigen::VectorXd::Ones(9)).cwiseAbs().maxCoeff(), 1e-10 * beam.K.diagonal().maxCoeff());
}

// The element is exact for loads on nodes, so any mesh gives the deflection of the stepped beam.
TEST(SymmetricBeam, DeflectionOfTheBackupRoll)
{
  const FourHigh stand = demo_drawing();
  SteppedBeam exact    = backup_beam(stand);
  exact.half_load      = 1e-9;
  const RollBody roll  = beam_roll("roll", stand.backup_roll, stand.steel, 3, 0.7);
  Eigen::MatrixXd K    = roll.K;
  const Eigen::Index n = 6;  // nodes before the bearing centre; the overhang is straight
  ASSERT_EQ(roll.seat[n], 1);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < K.rows(); ++i)
    if (i != n)
      free.push_back(i);
  const Eigen::MatrixXd held = K(free, free);
  const Eigen::VectorXd u    = held.llt().solve(Eigen::VectorXd::Unit(held.rows(), 0));
  for (const int i : {0, 2, 3, 5})
    EXPECT_TRUE(near(u[i], deflection(exact, roll.nodes[i]), within(1e-7, "load on 1e-9 m instead of a point")));
}

TEST(SymmetricBeam, FreeUniformEulerBeam)
{
  const double EI = 2e7, m = 80, half = 1.5;
  const SymmetricBeam beam = symmetric_beam({{half, 100, {EI, endless}, m}});
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(beam.K,
                                                                        Eigen::MatrixXd(beam.mass.asDiagonal()));
  const double root = 4.730040744862704;  // cos x cosh x = 1
  EXPECT_TRUE(near(std::sqrt(modes.eigenvalues()[1]), root * root / (4 * half * half) * std::sqrt(EI / m),
                   within(1e-4, "lumped mass, 100 elements per half: error of order 1e-4")));
}

TEST(SymmetricBeam, RefusesWhatIsNoBeam)
{
  EXPECT_EQ(refusal([] { symmetric_beam({}); }), "a beam needs at least one span");
  EXPECT_EQ(
      refusal([] {
        symmetric_beam({{0.5, 4, {1e9, 1e9}, 0}});
      }),
      "beam span of 0.5 m with E I = 1e+09 N m2, 0 kg/m and 4 elements: length, stiffness, mass and number of "
      "elements must be positive");
}

TEST(BeamRoll, RefusesImpossibleRolls)
{
  FourHigh stand               = demo_drawing();
  const auto make              = [&] { beam_roll("upper work roll", stand.work_roll, stand.steel, 4, 0.7); };
  stand.work_roll.bearing_span = 1.3;
  EXPECT_EQ(refusal(make),
            "upper work roll: bearing span 1.3 m; the bearing centres must lie on the necks, between 1.4 m "
            "(barrel length) and 2.32 m (length of the roll)");
  stand.work_roll.bearing_span = 2.4;
  EXPECT_NE(refusal(make), "accepted");
  stand.work_roll.bearing_span  = 2;
  stand.work_roll.neck_diameter = 0;
  EXPECT_EQ(refusal(make),
            "upper work roll: barrel 0.42 x 1.4 m, neck 0 x 0.46 m: every dimension must be positive");
}

TEST(BeamRoll, BearingAtTheVeryEnd)
{
  FourHigh stand               = demo_drawing();
  stand.work_roll.bearing_span = 2.32;
  const RollBody roll          = beam_roll("roll", stand.work_roll, stand.steel, 4, 0.7);
  EXPECT_EQ(roll.nodes.size(), 9);
  EXPECT_EQ(roll.seat[8], 1);
}

TEST(LinePoints, HatFunctionsAndGaussPointsShareTheWholeLoad)
{
  const FourHigh stand = demo_drawing();
  const RollBody roll  = beam_roll("roll", stand.work_roll, stand.steel, 8, 0.7);
  for (const double half : {0.7, 0.5, 0.013}) {
    const LinePoints points = line_points(roll, roll, half);
    EXPECT_TRUE(near(points.share.sum(), 1, within(1e-14, "the hat functions add up to one")));
    EXPECT_TRUE(near(points.share.dot(points.z), half / 2, within(1e-13, "linear functions are met exactly")));
  }
  RollBody modal;
  modal.n_barrel          = 3;
  modal.half_barrel       = 0.7;
  const LinePoints points = line_points(modal, modal, 0.5);
  EXPECT_TRUE(near(points.share.dot(points.z.array().pow(8).matrix()), std::pow(0.5, 8) / 9,
                   within(1e-13, "products of polynomials of degree 4 are integrated exactly")));
}
