#include "reduce/stack/stack_state.h"

namespace mill::reduce {
double loaded_tangent(const PairState &pair, const Eigen::VectorXd &change)
{
  // Where the contact is open the load stays zero, and the approach has no weight.
  const Eigen::ArrayXd q = pair.load.array(), d = pair.approach.array(), w = pair.weight.array(),
                       dq     = change.array();
  const Eigen::ArrayXd closer = (pair.tangent.array() > 0).select(dq / pair.tangent.array().max(1e-300), 0.);
  const double force = (w * q).sum(), more = (w * dq).sum(), weighted = (w * q * d).sum() / force;
  return more / (((w * (dq * d + q * closer)).sum() - weighted * more) / force);
}
}  // namespace mill::reduce
