#include "reduce/stack/stack_state.h"
#include <cmath>
#include <limits>

namespace mill::reduce {
namespace {
// Of the sum of magnitudes in the denominator of (51.21): below it the places of the contact move so differently
// that the sum is a small difference of them, and may be negative.
constexpr double least_share = 0.5;
}  // namespace

double loaded_tangent(const PairState &pair, const Eigen::VectorXd &change)
{
  // Where the contact is open the load stays zero, and the approach has no weight.
  const Eigen::ArrayXd q = pair.load.array(), d = pair.approach.array(), w = pair.weight.array(),
                       dq     = change.array();
  const Eigen::ArrayXd closer = (pair.tangent.array() > 0).select(dq / pair.tangent.array().max(1e-300), 0.);
  const double force = (w * q).sum(), more = (w * dq).sum(), weighted = (w * q * d).sum() / force;
  const Eigen::ArrayXd reweighs = w * dq * (d - weighted), moves = w * q * closer;
  const double closing = (reweighs + moves).sum(), magnitude = (reweighs.abs() + moves.abs()).sum();
  if (!(closing / more > least_share * magnitude / std::abs(more)))
    return std::numeric_limits<double>::quiet_NaN();
  return more * force / closing;
}
}  // namespace mill::reduce
