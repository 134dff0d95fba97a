// Forward automatic differentiation against complex step, operation by operation.
#include "core/numerics/derivative.h"
#include "tests/support/near.h"
#include <Eigen/LU>

namespace mill::bite {
namespace {
using Complex = std::complex<double>;

template <class T> T every_function(const T &x, const T &y)
{
  using std::asin;
  using std::asinh;
  using std::atan;
  using std::atanh;
  using std::cos;
  using std::cosh;
  using std::exp;
  using std::log;
  using std::pow;
  using std::sin;
  using std::sinh;
  using std::sqrt;
  using std::tan;
  using std::tanh;
  T sum = exp(x * y) / sqrt(1.0 + x) + atan(y) * pow(x, 0.3) - log(y) * tan(x) + expm1(x) * log1p(y);
  sum += cos(x) * sin(y) + tanh(x * y) + asinh(x / y) - 2.0 / x + pow(x, y) + pow(2.0, y);
  sum *= sinh(x) - cosh(y) + asin(x) * atanh(y);
  sum /= 3.0 - x;
  return sum - (1.0 - y);
}
}  // namespace

TEST(Dual, EveryFunctionAgainstComplexStep)
{
  const double x = 0.4, y = 0.7, step = 1e-30;
  const Dual<2> f = every_function(Dual<2>::variable(x, 0), Dual<2>::variable(y, 1));
  const auto same = within(1e-14, "both exact; rounding of some thirty operations");
  EXPECT_TRUE(near(f.value, every_function(x, y), same));
  EXPECT_TRUE(near(f.by[0], every_function(Complex(x, step), Complex(y)).imag() / step, same));
  EXPECT_TRUE(near(f.by[1], every_function(Complex(x), Complex(y, step)).imag() / step, same));
}

TEST(Dual, FunctionsOfTwoNumbersAndBranches)
{
  const auto x = Dual<2>::variable(3, 0), y = Dual<2>::variable(-4, 1);
  const auto closed = within(1e-15, "closed form");
  EXPECT_TRUE(near(hypot(x, y).by[0], 0.6, closed));
  EXPECT_TRUE(near(hypot(x, y).by[1], -0.8, closed));
  EXPECT_TRUE(near(atan2(y, x).by[0], 4.0 / 25, closed));
  EXPECT_TRUE(near(atan2(y, x).by[1], 3.0 / 25, closed));
  EXPECT_EQ(abs(y).by[1], -1);
  EXPECT_EQ(abs(x).by[0], 1);
  EXPECT_TRUE(near(acos(Dual<1>::variable(0.5, 0)).by[0], -1 / std::sqrt(0.75), closed));
  EXPECT_TRUE(y < x && x > 2.0 && y <= y && x != y);
}

// A power law at zero strain: infinite slope, but nothing where the strain does not depend on the input.
TEST(Dual, InfiniteSlopesEnterOnlyWhereTheArgumentMoves)
{
  auto strain       = Dual<2>::variable(0, 1);
  const auto stress = pow(strain, 0.2);
  EXPECT_EQ(stress.value, 0);
  EXPECT_EQ(stress.by[0], 0);
  EXPECT_EQ(stress.by[1], INFINITY);
  EXPECT_EQ(pow(strain, 1.0).by[1], 1);
  EXPECT_EQ(pow(strain, 2.0).by[1], 0);
  EXPECT_EQ(pow(strain, 0.0).by[1], 0);
}

// exp(x) - 1 far below zero: its slope exp(x) must not come from 1 + (exp(x) - 1).
TEST(Dual, ExponentialsWithoutCancellation)
{
  const auto rounding = within(4e-16, "last digit");
  EXPECT_TRUE(near(expm1(Dual<1>::variable(-30, 0)).by[0], std::exp(-30.0), rounding));
  EXPECT_TRUE(near(expm1(Dual<1>::variable(1e-12, 0)).value, std::expm1(1e-12), rounding));
  EXPECT_TRUE(near(expm1(Complex(1e-12, 0)).real(), std::expm1(1e-12), rounding));
  EXPECT_TRUE(near(log1p(Complex(1e-12, 1e-30)).real(), std::log1p(1e-12), rounding));
  EXPECT_TRUE(near(log1p(Complex(0.5, 1e-30)).imag(), 1e-30 / 1.5, rounding));
}

TEST(Dual, IsAScalarOfEigen)
{
  using Number = Dual<1>;
  Eigen::Matrix<Number, 3, 3> A;
  Eigen::Matrix<Number, 3, 1> b;
  const Number p = Number::variable(0.3, 0);
  for (int i = 0; i < 3; ++i) {
    b[i] = 1.0 + p * double(i);
    for (int j = 0; j < 3; ++j)
      A(i, j) = (i == j ? 4.0 : 1.0) + p * double(i * j);
  }
  const Eigen::Matrix<Number, 3, 1> x        = A.partialPivLu().solve(b);
  const Eigen::Matrix<Number, 3, 1> residual = A * x - b;  // must vanish with its derivative
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(near(residual[i].value, 0, within(1e-14, "zero up to rounding of numbers of order one", 1)));
    EXPECT_TRUE(near(residual[i].by[0], 0, within(1e-14, "zero up to rounding of numbers of order one", 1)));
  }
  EXPECT_GT(std::abs(x[1].by[0]), 1e-3);
}
}  // namespace mill::bite
