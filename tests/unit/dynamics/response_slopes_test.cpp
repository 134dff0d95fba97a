// Derivatives of the response against differences of a solution without modes.
#include "dynamics/response/modes.h"
#include "dynamics/response/response_slopes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <Eigen/LU>
#include <cmath>
#include <complex>

using namespace mill;
using namespace mill::dynamics;

namespace {
const Eigen::VectorXd ratios = (Eigen::VectorXd(6) << 0.01, 0.013, 0.008, 0.02, 0.011, 0.016).finished();

/// Accelerations of all masses per newton by one factorisation, damping matrix from the modes of this very model.
Eigen::VectorXcd solved(const MillModel &model, const Eigen::VectorXd &damping, const double w)
{
  const Modes natural     = modes(model);
  const Eigen::MatrixXd W = model.M.asDiagonal() * natural.shape;
  const Eigen::MatrixXd C = W * (4 * M_PI * damping.cwiseProduct(natural.frequency)).asDiagonal() * W.transpose();
  Eigen::MatrixXcd A(6, 6);
  A.real() = model.K - w * w * Eigen::MatrixXd(model.M.asDiagonal());
  A.imag() = w * C;
  return -w * w * A.partialPivLu().solve(model.b.cast<std::complex<double>>());
}

MillModel changed(const std::string &name, const double factor)
{
  LumpedModel stand = published_stand();
  (name[0] == 'K' ? stand.K[std::size_t(name[1] - '1')] : stand.M[std::size_t(name[1] - '1')]).value *= factor;
  return mill_model(stand, settings(ForceMeaning::measured, 0.01));
}
}  // namespace

TEST(ResponseSlopes, AgreeWithDifferencesOfASolutionWithoutModes)
{
  const SlopedStand stand = sloped_stand(changed("K1", 1), ratios);
  ASSERT_EQ(stand.names.size(), 12u);  // K4 does not act together with a measured force
  // Two of the reference's frequencies stand close to modes, where a slope is steepest.
  for (const double f : {35., 218., 400., 680., 760., 1500.}) {
    const double w         = 2 * M_PI * f;
    const ResponseSlopes r = response_slopes(stand, stand.shape, w);
    EXPECT_LT((r.value - solved(changed("K1", 1), ratios, w)).norm(), 1e-10 * r.value.norm());
    for (std::size_t p = 0; p < stand.names.size(); ++p) {
      // Fourth-order differences; what is left of them is rounding over the step, some 1e-8 of the largest slope.
      const auto value_at = [&](const double h) {
        return solved(changed(stand.names[p], std::exp(h)), ratios, w);
      };
      const double h = 2e-4;
      const Eigen::VectorXcd ref =
          (8 * (value_at(h) - value_at(-h)) - (value_at(2 * h) - value_at(-2 * h))) / (12 * h);
      EXPECT_LT((r.parameters.col(Eigen::Index(p)) - ref).norm(), 1e-7 * (ref.norm() + r.value.norm()))
          << stand.names[p] << " at " << f << " Hz";
    }
    for (Eigen::Index i = 0; i < 6; ++i) {
      const auto value_at = [&](const double h) {
        Eigen::VectorXd z = ratios;
        z[i] *= std::exp(h);
        return solved(changed("K1", 1), z, w);
      };
      const double h = 1e-4;
      const Eigen::VectorXcd ref =
          (8 * (value_at(h) - value_at(-h)) - (value_at(2 * h) - value_at(-2 * h))) / (12 * h);
      EXPECT_LT((r.dampings.col(i) - ref).norm(), 1e-7 * (ref.norm() + r.value.norm())) << "mode " << i;
    }
  }
}
