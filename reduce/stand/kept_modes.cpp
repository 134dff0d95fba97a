#include "reduce/stand/kept_modes.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
Component with_modes(const Component &component, const Eigen::Index kept)
{
  const Eigen::Index n_i = component.n_interface(), all = component.fixed_frequency.size();
  const Eigen::Index n_m = std::min(kept, all), n = n_i + n_m;
  Component c       = component;
  c.M               = component.M.topLeftCorner(n, n);
  c.K               = component.K.topLeftCorner(n, n);
  c.fixed_frequency = component.fixed_frequency.head(n_m);
  if (component.axis.size() > 0)
    c.axis = component.axis.leftCols(n);
  // A mode of unit modal mass at w_j that meets the interface with m = M_cj adds m m^T / w_j^2 to the residual.
  for (Eigen::Index j = n_m; j < all; ++j) {
    const Eigen::VectorXd m = component.M.col(n_i + j).head(n_i);
    const double w          = 2 * M_PI * component.fixed_frequency[j];
    c.residual += m * m.transpose() / (w * w * component.M(n_i + j, n_i + j));
  }
  return c;
}
}  // namespace mill::reduce
