// Routh's array against roots that are known, and against eigenvalues.
#include "core/base/errors.h"
#include "dynamics/chatter/chatter.h"
#include "dynamics/chatter/routh.h"
#include "tests/support/near.h"
#include <cmath>
#include <complex>
#include <random>

using namespace mill;
using namespace mill::dynamics;

namespace {
// Companion matrix of  s^n + p[0] s^(n-1) + ... + p[n-1].
Eigen::MatrixXd companion(const std::vector<double> &p)
{
  const auto n      = Eigen::Index(p.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    A(i, i + 1) = 1;
  for (Eigen::Index i = 0; i < n; ++i)
    A(n - 1, i) = -p[std::size_t(n - 1 - i)];
  return A;
}

// Blocks with the given roots a +- ib (b = 0: one real root), mixed by an exact similarity of small integers.
Eigen::MatrixXd with_roots(const std::vector<std::complex<double>> &roots)
{
  Eigen::Index n = 0;
  for (const auto root : roots)
    n += root.imag() != 0 ? 2 : 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::Index i    = 0;
  for (const auto root : roots) {
    A(i, i) = root.real();
    if (root.imag() != 0) {
      A.block(i, i, 2, 2) << root.real(), root.imag(), -root.imag(), root.real();
      ++i;
    }
    ++i;
  }
  for (Eigen::Index k = 0; k + 1 < n; ++k) {  // (I + e_k e_k+1^T) A (I - e_k e_k+1^T)
    A.row(k) += A.row(k + 1);
    A.col(k + 1) -= A.col(k);
  }
  return A;
}
}  // namespace

TEST(Routh, NumberOfKnownRootsIsRight)
{
  const RouthCount stable = routh_count(with_roots({{-1, 2}, {-0.5, 0}, {-0.001, 7}}));
  EXPECT_EQ(stable.unstable, 0);
  EXPECT_EQ(stable.on_axis, 0);
  EXPECT_EQ(stable.first_column.size(), 6);
  EXPECT_GT(stable.first_column.minCoeff(), 0);
  EXPECT_EQ(routh_count(with_roots({{1, 2}, {-0.5, 0}, {-0.001, 7}})).unstable, 2);
  EXPECT_EQ(routh_count(with_roots({{1, 0}, {0.25, 8}, {-3, 1}})).unstable, 3);
}

TEST(Routh, WorksForALineNextToTheAxis)
{
  const Eigen::MatrixXd A = with_roots({{-1, 2}, {-0.5, 0}, {-3, 7}});
  EXPECT_EQ(routh_count(A, -0.75).unstable, 1);
  EXPECT_EQ(routh_count(A, -2).unstable, 3);
  EXPECT_EQ(routh_count(A, -2).on_axis, 0);
  EXPECT_EQ(routh_count(A, -1).on_axis, 2);
}

TEST(Routh, ReportsRootsOnTheAxis)
{
  const RouthCount pair = routh_count(with_roots({{0, 2}, {-1, 3}, {0.5, 1}}));
  EXPECT_EQ(pair.unstable, 2);
  EXPECT_EQ(pair.on_axis, 2);
  const RouthCount two = routh_count(with_roots({{0, 2}, {0, 5}, {-1, 0}}));
  EXPECT_EQ(two.unstable, 0);
  EXPECT_EQ(two.on_axis, 4);
  const RouthCount origin = routh_count(with_roots({{0, 0}, {-1, 4}, {2, 0}}));
  EXPECT_EQ(origin.unstable, 1);
  EXPECT_EQ(origin.on_axis, 1);
}

// Symmetric to the origin, but not on the axis: a row vanishes all the same.
TEST(Routh, SymmetricRootsAreCountedOnTheirSides)
{
  const RouthCount reals = routh_count(with_roots({{2, 0}, {-2, 0}, {-1, 3}}));
  EXPECT_EQ(reals.unstable, 1);
  EXPECT_EQ(reals.on_axis, 0);
  const RouthCount four = routh_count(with_roots({{1, 2}, {-1, 2}, {0, 3}}));
  EXPECT_EQ(four.unstable, 2);
  EXPECT_EQ(four.on_axis, 2);
}

// s^4 + s^3 + 2 s^2 + 2 s + 3: the array begins a row with a zero that does not mean roots on the axis.
// Roots 0.4057 +- 1.2928 i and -0.9057 +- 0.9020 i.
TEST(Routh, HandlesALeadingZero)
{
  const RouthCount count = routh_count(companion({1, 2, 2, 3}));
  EXPECT_EQ(count.unstable, 2);
  EXPECT_EQ(count.on_axis, 0);
}

TEST(Routh, AgreesWithEigenvaluesOfRandomSystems)
{
  std::mt19937 draw(7);
  const auto between = [&](const double a, const double b) { return a + (b - a) * double(draw()) / 4294967296.; };
  int agree          = 0;
  for (int system = 0; system < 40; ++system) {
    const int n = 3 + system % 12;
    Eigen::MatrixXd A(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        A(i, j) = between(-1, 1) * std::pow(10, between(-2, 2)) - (i == j ? 3 : 0);
    agree += routh_count(A).unstable == int((eigenvalues(A).real().array() > 0).count());
  }
  EXPECT_EQ(agree, 40);
}

// Roots over ten decades: a double does not hold the polynomial.
TEST(Routh, HandlesRootsFarApart)
{
  std::vector<std::complex<double>> roots;
  for (int i = -5; i <= 5; ++i)
    roots.push_back({-std::pow(10, i), std::pow(10, i)});
  const Eigen::MatrixXd A = with_roots(roots);
  EXPECT_EQ(routh_count(A).unstable, 0);
  roots[3].real(1e-4);
  EXPECT_EQ(routh_count(with_roots(roots)).unstable, 2);
}

TEST(Routh, HalvingFindsWhereTheCountChanges)
{
  const auto matrix = [](const double v) { return with_roots({{v - 3.25, 10}, {-1, 2}, {-7, 0}}); };
  EXPECT_TRUE(near(boundary_by_routh(matrix, 1, 10, 1e-9), 3.25, within(1e-9, "halving to 1e-9")));
}
