#include "reduce/bite/arc/half_plane.h"
#include "core/base/errors.h"
#include <cmath>

namespace mill::bite {
ArcFlexibility half_plane_flexibility(const Eigen::VectorXd &x, const Material &roll, const double roll_radius)
{
  const Eigen::Index n = x.size();
  if (n < 2)
    throw InputError("half plane: the surface needs at least two places");
  for (Eigen::Index i = 1; i < n; ++i)
    if (!(x[i] > x[i - 1]))
      throw InputError("half plane: the places along the surface must rise");
  const double compliance = 2 * (1 - roll.poisson_ratio * roll.poisson_ratio) / (M_PI * roll.youngs_modulus);
  const double datum      = std::log(2 * roll_radius) - 1;
  ArcFlexibility flexibility{x, Eigen::MatrixXd::Zero(n, n), "half plane"};
  for (Eigen::Index j = 0; j + 1 < n; ++j) {
    const double width = x[j + 1] - x[j];
    for (Eigen::Index i = 0; i < n; ++i) {
      // Of the logarithm over the piece: its integral and its first moment, from both ends
      const double a = x[j] - x[i], b = x[j + 1] - x[i];
      const double la = a == 0 ? 0 : std::log(std::abs(a)), lb = b == 0 ? 0 : std::log(std::abs(b));
      const double whole  = b * lb - a * la - width;
      const double moment = 0.5 * (b * b * lb - a * a * la) - 0.25 * (b * b - a * a);
      flexibility.influence(i, j) += compliance * (0.5 * width * datum - (b * whole - moment) / width);
      flexibility.influence(i, j + 1) += compliance * (0.5 * width * datum - (moment - a * whole) / width);
    }
  }
  return flexibility;
}

Eigen::MatrixXd half_plane_slope(const Eigen::VectorXd &x, const Material &roll)
{
  const Eigen::Index n    = x.size();
  const double compliance = 2 * (1 - roll.poisson_ratio * roll.poisson_ratio) / (M_PI * roll.youngs_modulus);
  Eigen::MatrixXd slope   = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j + 1 < n; ++j) {
    const double width = x[j + 1] - x[j];
    for (Eigen::Index i = 0; i < n; ++i) {
      // The logarithms at a place itself cancel between the pieces on its two sides.
      const double a = x[j] - x[i], b = x[j + 1] - x[i];
      const double log = (b == 0 ? 0 : std::log(std::abs(b))) - (a == 0 ? 0 : std::log(std::abs(a)));
      slope(i, j) += compliance * (b / width * log - 1);
      slope(i, j + 1) += compliance * (1 - a / width * log);
    }
  }
  return slope;
}
}  // namespace mill::bite
