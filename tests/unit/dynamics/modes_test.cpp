// Modes of the published stand against the reference values, and what must hold for any chain.
#include "core/base/errors.h"
#include "dynamics/response/modes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"

using namespace mill;
using namespace mill::dynamics;

const MillModel published = mill_model(published_stand(), settings(ForceMeaning::published, 0.01));

namespace {
Eigen::MatrixXd reference_matrix(const std::string &entry)
{
  const auto rows = reference(entry).get<std::vector<std::vector<double>>>();
  Eigen::MatrixXd matrix(rows.size(), rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      matrix(Eigen::Index(i), Eigen::Index(j)) = rows[i][j];
  return matrix;
}
}  // namespace

TEST(Modes, FrequenciesAndShapesAreThoseOfThePublishedStand)
{
  const Modes solution = modes(published);
  EXPECT_TRUE(near(solution.frequency, reference_vector("modes.published.frequencies"),
                   within(1e-6, "eigenvalues in double precision")));
  const Eigen::MatrixXd shapes = reference_matrix("modes.published.shapes");
  for (int k = 0; k < 6; ++k) {
    const double sign = solution.shape.col(k).dot(shapes.col(k)) > 0 ? 1 : -1;
    EXPECT_TRUE(near(sign * solution.shape.col(k), shapes.col(k),
                     within(1e-5, "eigenvectors in double precision, of the largest component",
                            shapes.col(k).cwiseAbs().maxCoeff())))
        << "mode " << k + 1;
  }
}

TEST(Modes, StrainEnergySharesPerSpringAreThoseOfTheReference)
{
  const Eigen::MatrixXd shares = reference_matrix("modes.published.strain_energy");
  const Modes solution         = modes(published);
  for (int k = 0; k < 6; ++k)
    EXPECT_TRUE(near(solution.strain_share.row(k).transpose(), shares.row(k).transpose(),
                     within(1e-6, "quadratic in shapes of double precision, of the whole energy", 1)))
        << "mode " << k + 1;
}

TEST(Modes, StrainShareIsTwiceTheSensitivityOfTheFrequency)
{
  const Modes solution = modes(published);
  for (std::size_t spring = 0; spring < 7; ++spring) {
    const auto frequency = [&](const double factor) {
      auto changed = published_stand();
      changed.K[spring].value *= factor;
      return modes(mill_model(changed, settings(ForceMeaning::published, 0))).frequency;
    };
    const double step = 1e-4;
    const Eigen::VectorXd elasticity =
        (frequency(1 + step) - frequency(1 - step)).cwiseQuotient(2 * step * solution.frequency);
    EXPECT_TRUE(near(elasticity, solution.strain_share.col(Eigen::Index(spring)) / 2,
                     within(1e-6, "central difference: error of order step^2 = 1e-8, rounding 1e-12/step", 1)));
  }
}

TEST(Modes, EnergySharesAndMassNormAddUp)
{
  const Modes solution = modes(published);
  for (int k = 0; k < 6; ++k) {
    EXPECT_TRUE(near(solution.strain_share.row(k).sum(), 1, within(1e-12, "whole energy")));
    EXPECT_TRUE(near(solution.kinetic_share.row(k).sum(), 1, within(1e-12, "V^T M V = 1")));
    EXPECT_GE(solution.kinetic_share.row(k).minCoeff(), 0);
  }
}

TEST(Modes, ModalDampingGivesEveryPoleItsRatio)
{
  const auto all_poles = poles(mill_model(published_stand(), settings(ForceMeaning::measured, 0.013)));
  const auto undamped  = modes(mill_model(published_stand(), settings(ForceMeaning::measured, 0)));
  ASSERT_EQ(all_poles.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_TRUE(near(all_poles[k].damping, 0.013,
                     within(1e-9, "modes decouple exactly; eigenvalues of a 12 x 12 matrix")));
    EXPECT_TRUE(near(all_poles[k].frequency, undamped.frequency[Eigen::Index(k)], within(1e-9, "|lambda| = w")));
  }
}

TEST(Modes, LossFactorNeedsASpringOfTheChain)
{
  EXPECT_THROW(loss_factor_poles(published, "K8", 0.01), InputError);
}

// A stand whose springs are all stiffer by e1 and whose masses are all heavier by e2 vibrates faster by their
// halves.
TEST(Modes, ErrorOfAFrequencyIsHalfThatOfSpringsAndMasses)
{
  LumpedModel stand = published_stand();
  for (Parameter &K : stand.K)
    K.error_estimate = 0.04;
  for (Parameter &M : stand.M)
    M.error_estimate = 0.02;
  const Modes solution = modes(published);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_TRUE(near(mode_error(solution, i, stand).error, 0.03, within(1e-4, "shares below 1e-5 are left out")));
  stand.K[0].error_estimate = stand.M[0].error_estimate = not_given;
  stand.M[0].error_lacks                                = {"frame.upper_post_mass_tolerance"};
  const auto error                                      = mode_error(solution, 0, stand);
  EXPECT_TRUE(std::isnan(error.error));
  EXPECT_EQ(error.lacks, (std::vector<std::string>{"K1", "frame.upper_post_mass_tolerance"}));
}
