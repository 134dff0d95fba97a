#include "core/numerics/bounded_least_squares.h"
#include "tests/support/near.h"
#include <Eigen/QR>
#include <gtest/gtest.h>

using namespace mill;

namespace {
// A fixed matrix without structure.
Eigen::MatrixXd matrix(const Eigen::Index rows, const Eigen::Index columns, const int kind)
{
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](const Eigen::Index i, const Eigen::Index j) {
    return std::cos(double(1 + kind + 7 * i + 13 * j * j + i * j));
  });
}
}  // namespace

// Conditions of Karush, Kuhn and Tucker: the slope is zero inside and points out of the bounds at them.
TEST(BoundedLeastSquares, MeetsTheConditionsOfAnOptimum)
{
  int at_bounds = 0;
  for (int kind = 0; kind < 50; ++kind) {
    const Eigen::Index n     = 1 + kind % 6;
    const Eigen::MatrixXd A  = matrix(n + 2, n, kind);
    const Eigen::VectorXd b  = 3 * matrix(n + 2, 1, 2 * kind);
    const Eigen::VectorXd lo = Eigen::VectorXd::Constant(n, -0.4), hi = Eigen::VectorXd::Constant(n, 0.7);
    const Eigen::VectorXd x = bounded_least_squares(A, b, lo, hi), slope = A.transpose() * (A * x - b);
    for (Eigen::Index i = 0; i < n; ++i) {
      ASSERT_GE(x[i], lo[i]);
      ASSERT_LE(x[i], hi[i]);
      if (x[i] == lo[i])
        EXPECT_GT(slope[i], -1e-9) << kind;
      else if (x[i] == hi[i])
        EXPECT_LT(slope[i], 1e-9) << kind;
      else
        EXPECT_TRUE(near(slope[i], 0, within_absolute(1e-10, "rounding"))) << kind;
      at_bounds += x[i] == lo[i] || x[i] == hi[i];
    }
  }
  EXPECT_GT(at_bounds, 50);
}

TEST(BoundedLeastSquares, IsTheLeastSquaresWhereNoBoundIsInTheWay)
{
  const Eigen::MatrixXd A  = matrix(7, 4, 3);
  const Eigen::VectorXd b  = matrix(7, 1, 5);
  const Eigen::VectorXd lo = Eigen::VectorXd::Constant(4, -100), hi = Eigen::VectorXd::Constant(4, 100);
  const Eigen::VectorXd exact = A.colPivHouseholderQr().solve(b), x = bounded_least_squares(A, b, lo, hi);
  for (Eigen::Index i = 0; i < 4; ++i)
    EXPECT_TRUE(near(x[i], exact[i], within(1e-12, "rounding", 1)));
}
