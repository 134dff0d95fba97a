// Modes of a stand: shares, scaling laws, symmetry, loose parts.
#include "reduce/stand/six_masses.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/Dense>
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
StandSprings scaled(StandSprings s, const double stiffness, const double mass)
{
  for (double *K : {&s.K1, &s.K7, &s.K3, &s.K5, &s.K4, &s.K_Zy_upper, &s.K_Zy_lower})
    *K *= stiffness;
  s.M1 *= mass;
  s.M6 *= mass;
  return s;
}

FourHigh scaled(FourHigh s, const double length, const double modulus)
{
  for (Roll *r : {&s.work_roll, &s.backup_roll}) {
    for (double *l :
         {&r->barrel_diameter, &r->barrel_length, &r->neck_diameter, &r->neck_length, &r->bearing_span})
      *l *= length;
    for (double *m : {&r->bearing_mass, &r->chock_mass_upper, &r->chock_mass_lower})
      *m *= std::pow(length, 3);
  }
  s.steel.youngs_modulus *= modulus;
  s.strip.width *= length;
  Frame &f = s.frame;
  for (double *m : {&f.cylinder_mass, &f.balance_mass})
    *m *= std::pow(length, 3);
  for (double *K :
       {&f.oil_column_stiffness, &f.cylinder_body_stiffness, &f.upper_chock_stiffness, &f.lower_chock_stiffness})
    *K *= length * modulus;
  return s;
}

Eigen::VectorXd frequencies(const FourHigh &drawing, const StandSprings &springs)
{
  return stand_modes(beam_stand(drawing, springs, 8)).frequency.head(14);
}

/// Upper and lower half alike: no cylinder, no upper chock apart, one spring between frame and backup roll.
struct Symmetric {
  FourHigh drawing = demo_drawing();
  StandSprings springs;
  Symmetric(const double K4)
  {
    Frame &f                             = drawing.frame;
    drawing.work_roll.chock_mass_upper   = drawing.work_roll.chock_mass_lower;
    drawing.backup_roll.chock_mass_upper = drawing.backup_roll.chock_mass_lower = 0;
    f.cylinder_mass = f.balance_mass = 0;
    f.lower_chock_stiffness =
        1 / (1 / f.oil_column_stiffness + 1 / f.cylinder_body_stiffness + 1 / f.upper_chock_stiffness);
    springs    = demo_springs(drawing);
    springs.K7 = springs.K1;
    springs.M6 = springs.M1;
    springs.K4 = K4;
  }
};
}  // namespace

TEST(StandModes, SharesAndNorms)
{
  const StandModel stand = demo_beams(demo_drawing());
  const StandModes modes = stand_modes(stand, 1500);
  const Eigen::Index m   = modes.frequency.size();
  ASSERT_GT(m, 10);
  EXPECT_LE(modes.frequency[m - 1], 1500);
  EXPECT_TRUE((modes.shape.transpose() * stand.M * modes.shape).isIdentity(1e-10));
  EXPECT_TRUE(modes.kinetic.colwise().sum().isConstant(1, 1e-10));
  EXPECT_TRUE((modes.strain.colwise().sum() + modes.strain_of_part.colwise().sum()).isConstant(1, 1e-7));
  EXPECT_TRUE(std::isnan(modes.error_estimate[0]));
  const Eigen::MatrixXd points = point_rows(stand, 6) * modes.shape;
  for (Eigen::Index k = 0; k < m; ++k)
    EXPECT_EQ(points.col(k).maxCoeff(), points.col(k).cwiseAbs().maxCoeff()) << "mode " << k + 1;
}

TEST(StandModes, ErrorEstimateFromAHalfAsFineMesh)
{
  const FourHigh drawing  = demo_drawing();
  const StandSprings s    = demo_springs(drawing);
  StandModes fine         = stand_modes(beam_stand(drawing, s, 16), 1000);
  const StandModes finest = stand_modes(beam_stand(drawing, s, 48), 1000);
  estimate_errors(fine, stand_modes(beam_stand(drawing, s, 8), 1000));
  for (const int k : {3, 6, 7, 8, 11}) {  // where bending of a roll matters
    const double error = std::abs(fine.frequency[k] / finest.frequency[k] - 1);
    EXPECT_GT(fine.error_estimate[k], 0.5 * error) << k;
    EXPECT_LT(fine.error_estimate[k], 2 * error) << k;
  }
}

TEST(StandModes, ResidualGivesTheErrorOfLeftOutModes)
{
  StandModel stand       = chain_stand(demo_chain(demo_drawing()).model);
  stand.residual         = 1e-3 * stand.M;  // y^T residual y = 1e-3 for every mass-normalised mode
  const StandModes modes = stand_modes(stand);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double w = 2 * M_PI * modes.frequency[k];
    EXPECT_TRUE(near(modes.error_estimate[k], w * w * 0.5e-3, within(1e-12, "w^2 q^T residual q / 2")));
  }
}

TEST(StandModes, ScalingLaws)
{
  const FourHigh drawing  = demo_drawing();
  const StandSprings s    = demo_springs(drawing);
  const Eigen::VectorXd f = frequencies(drawing, s);
  const auto same         = within(1e-8, "the same problem in other units, conditioning of the beams");
  // Moduli and springs x 4: frequencies x 2.
  EXPECT_TRUE(near(frequencies(scaled(drawing, 1, 4), scaled(s, 4, 1)), (2 * f).eval(), same));
  // Lengths x 3 at the same material: springs x 3, masses x 27, frequencies / 3.
  EXPECT_TRUE(near(frequencies(scaled(drawing, 3, 1), scaled(s, 3, 27)), (f / 3).eval(), same));
}

TEST(StandModes, SymmetricStandSplits)
{
  const Symmetric pair(1e9), apart(0);
  const StandModel stand     = beam_stand(pair.drawing, pair.springs, 8);
  const StandModes modes     = stand_modes(stand);
  const Eigen::VectorXd open = stand_modes(beam_stand(apart.drawing, apart.springs, 8)).frequency;
  const Eigen::MatrixXd y    = point_rows(stand, 6) * modes.shape;
  Eigen::Index bite          = -1;
  for (Eigen::Index c = 0; c < Eigen::Index(stand.connections.size()); ++c)
    if (stand.connections[std::size_t(c)].name == "K4")
      bite = c;
  ASSERT_GE(bite, 0);
  int together = 0, against = 0;
  for (Eigen::Index k = 0; k < 14; ++k) {
    const double sum        = (y.col(k).head(3) + y.col(k).tail(3).reverse()).norm(),
                 difference = (y.col(k).head(3) - y.col(k).tail(3).reverse()).norm(), size = y.col(k).norm();
    EXPECT_LT(std::min(sum, difference), 1e-6 * size) << "mode " << k + 1;
    if (difference <
        sum) {  // both halves move alike: the strip is not squeezed, and a half alone has this frequency
      ++together;
      EXPECT_LT(modes.strain(bite, k), 1e-10);
      EXPECT_LT((open.array() / modes.frequency[k] - 1).abs().minCoeff(), 1e-9);
    } else {
      ++against;
      EXPECT_GT(modes.strain(bite, k), 1e-10);
    }
  }
  EXPECT_EQ(together, 7);
  EXPECT_EQ(against, 7);
}

TEST(StandModes, LoosePartsAreNamed)
{
  const StandModel stand = demo_beams(demo_drawing());
  const StandModel loose = without(stand, "K3");
  const std::string text =
      "stand model \"beam\": nothing holds the upper work roll in the vertical direction (y); it can "
      "move without straining any spring. Join it to a part that is held, by a spring with positive "
      "stiffness";
  EXPECT_EQ(refusal([&] { stand_modes(loose); }), text);
  EXPECT_EQ(refusal([&] { static_displacement(loose); }), text);
  const std::string lower = refusal([&] { static_displacement(without(stand, "K7")); });
  // The whole lower half hangs together; its heaviest part comes first.
  EXPECT_NE(
      lower.find("nothing holds the lower backup roll in the vertical direction (y), together with the lower work "
                 "roll, the lower frame;"),
      std::string::npos)
      << lower;
  EXPECT_EQ(lower.find("upper"), std::string::npos) << lower;
}

TEST(StandModes, MassMustBePositive)
{
  StandModel stand = chain_stand(demo_chain(demo_drawing()).model);
  stand.M(2, 2)    = 0;
  EXPECT_EQ(refusal([&] { stand_modes(stand); }),
            "stand model \"six-mass\": its mass matrix is not positive definite");
}
