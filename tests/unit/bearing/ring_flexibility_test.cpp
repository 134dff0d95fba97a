#include "core/base/errors.h"
#include "reduce/bearing/ring_flexibility.h"
#include "tests/support/near.h"
#include "tests/support/smooth_rings.h"
#include <Eigen/Eigenvalues>
#include <cmath>

using namespace mill;
using namespace mill::bearing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
VectorXd azimuths(const int Z, const double cage)
{
  return (cage + 2 * M_PI / Z * VectorXd::LinSpaced(Z, 0, Z - 1).array()).matrix();
}
}  // namespace

// The definition, term by term.
TEST(RingFlexibility, IsTheSumOverHarmonics)
{
  const int Z = 5, rows = 2, modes = 3, chock = 4, size = rows * modes;
  RingFlexibility rings = smooth_rings(rows, modes, 1e-10, chock);
  const VectorXd psi    = azimuths(Z, 0.3);
  const MatrixXd S      = flexibility_at(rings, psi);
  for (int r = 0; r < rows; ++r)
    for (int q = 0; q < rows; ++q)
      for (int j = 0; j < Z; ++j)
        for (int k = 0; k < Z; ++k)
          for (int a = 0; a < modes; ++a)
            for (int b = 0; b < modes; ++b) {
              double sum  = 0;
              const int i = r * modes + a, l = q * modes + b;
              for (int m = 0; m < 12; ++m)
                sum += (rings.inner[m](i, l) + rings.outer[m](i, l)) * std::cos(m * (psi[j] - psi[k]));
              for (int m = 0; m < chock; ++m)
                for (int n = 0; n < chock; ++n)
                  sum +=
                      rings.chock_cosine(m * size + i, n * size + l) * std::cos(m * psi[j]) * std::cos(n * psi[k]);
              for (int m = 1; m < chock; ++m)
                for (int n = 1; n < chock; ++n)
                  sum += rings.chock_sine((m - 1) * size + i, (n - 1) * size + l) * std::sin(m * psi[j]) *
                         std::sin(n * psi[k]);
              ASSERT_TRUE(near(S((r * Z + j) * modes + a, (q * Z + k) * modes + b), sum,
                               within(1e-12, "sums of the same terms", 1e-11)));
            }
  EXPECT_EQ(S, S.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(S).eigenvalues()[0], -1e-14 * S.norm());
}

TEST(RingFlexibility, StifferDividesEverything)
{
  const RingFlexibility rings = smooth_rings(2, 2, 1e-10, 3);
  const VectorXd psi          = azimuths(7, 0.1);
  const MatrixXd S = flexibility_at(rings, psi), T = flexibility_at(stiffer(rings, 1000), psi);
  EXPECT_LT((S - 1000 * T).cwiseAbs().maxCoeff(), 1e-13 * S.cwiseAbs().maxCoeff());
  EXPECT_THROW(stiffer(rings, 0), InputError);
}

// A row of rollers that turns with the cage by one pitch meets the same rings.
TEST(RingFlexibility, RoundRingsDoNotSeeTheCageAngle)
{
  const RingFlexibility rings = smooth_rings(1, 2, 1e-10);
  const MatrixXd S = flexibility_at(rings, azimuths(9, 0)), T = flexibility_at(rings, azimuths(9, 0.2));
  EXPECT_LT((S - T).cwiseAbs().maxCoeff(), 1e-13 * S.cwiseAbs().maxCoeff());
}

TEST(RingFlexibility, LineModesAreLegendres)
{
  const VectorXd x = VectorXd::LinSpaced(2001, -0.01, 0.01);
  const MatrixXd P = line_modes(x, 0.02, 5);
  for (int a = 0; a < 5; ++a) {
    EXPECT_TRUE(near(P(2000, a), 1, within(1e-14, "P_a(1) = 1")));
    for (int b = 0; b <= a; ++b) {
      const double integral =
          P.col(a).dot(P.col(b)) / 2000 * 2 - (P(0, a) * P(0, b) + P(2000, a) * P(2000, b)) / 2000;
      EXPECT_TRUE(
          near(integral, a == b ? 2.0 / (2 * a + 1) : 0, within_absolute(1e-4, "trapezoidal rule of 2000 steps")));
    }
  }
}

TEST(RingFlexibility, RefusesOtherSizes)
{
  RingFlexibility rings = smooth_rings(2, 2, 1e-10, 3);
  rings.inner[1].resize(3, 3);
  EXPECT_THROW(flexibility_at(rings, azimuths(4, 0)), InputError);
  rings = smooth_rings(2, 2, 1e-10, 3);
  rings.chock_sine.resize(1, 1);
  EXPECT_THROW(flexibility_at(rings, azimuths(4, 0)), InputError);
}

// Exchanged on one mesh nothing of the mesh is left; a round set and a chock with the same matrices are one thing.
TEST(RingFlexibility, SurroundingsAreExchanged)
{
  const int rows = 2, modes = 2, n = 4;
  const RingFlexibility round = smooth_rings(rows, modes, 1e-10, 0), block = smooth_rings(rows, modes, 1e-10, n);
  const VectorXd psi   = azimuths(7, 0.1);
  const auto exchanged = with_surroundings_of(block, block, round, n);
  EXPECT_LT((flexibility_at(exchanged, psi) - flexibility_at(round, psi)).norm(),
            1e-14 * flexibility_at(round, psi).norm());
  RingFlexibility coarse = stiffer(block, 1.1), other = stiffer(round, 1.1);
  other.outer.resize(n);
  const MatrixXd change = flexibility_at(with_surroundings_of(block, coarse, other, n), psi) -
                          flexibility_at(block, psi),
                 exact = flexibility_at(round, psi) - flexibility_at(block, psi);
  EXPECT_LT((change - exact / 1.1).norm(), 1e-14 * exact.norm()) << "shorter waves are those of the fine mesh";
  other.outer.resize(n - 1);
  EXPECT_THROW(with_surroundings_of(block, coarse, other, n), InputError);
}
