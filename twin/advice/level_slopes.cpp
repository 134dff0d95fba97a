#include "twin/advice/level_slopes.h"
#include "dynamics/response/response_slopes.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

// With a damper c on the gap the answer is  H_p / (1 + i w c H_gap),  H_gap that of the gap itself: both follow a
// parameter.  Accelerations in place of displacements turn i w c into c / (i w).
void join_gap_damper(dynamics::ResponseSlopes &r, const double damper, const double w)
{
  const Eigen::Index gap = r.value.size() - 1;
  const Complex z        = damper / Complex(0, w);
  const Complex less     = 1.0 + z * r.value[gap];
  const auto joined      = [&](Eigen::MatrixXcd &slopes) {
    const Eigen::RowVectorXcd of_gap = slopes.row(gap);
    slopes                           = slopes / less - r.value * of_gap * (z / (less * less));
  };
  joined(r.parameters);
  joined(r.dampings);
  r.value /= less;
}
}  // namespace

double LevelSlopes::of(const Eigen::Index place, const std::string &name) const
{
  const auto entry = std::find(names.begin(), names.end(), name);
  return entry == names.end() ? std::numeric_limits<double>::quiet_NaN() : slope(place, entry - names.begin());
}

LevelSlopes level_slopes(const dynamics::MillModel &model, const Eigen::VectorXd &damping, const double gap_damper,
                         const ForceBand &force)
{
  const dynamics::SlopedStand stand = dynamics::sloped_stand(model, damping);
  const Eigen::Index m = model.M.size(), p = Eigen::Index(stand.names.size());
  Eigen::MatrixXd seen(m + 1, stand.shape.cols());
  seen.topRows(m)    = stand.shape;
  seen.bottomRows(1) = stand.force.transpose();
  LevelSlopes s;
  s.names = stand.names;
  s.names.push_back("zeta");
  s.slope                = Eigen::MatrixXd::Zero(m, p + 1);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(m);
  for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
    const double w             = 2 * M_PI * force.frequency[k];
    dynamics::ResponseSlopes r = dynamics::response_slopes(stand, seen, w);
    if (gap_damper > 0)
      join_gap_damper(r, gap_damper, w);
    const Eigen::VectorXcd weighted = force.square[k] * r.value.head(m).conjugate();
    square += force.square[k] * r.value.head(m).cwiseAbs2();
    s.slope.leftCols(p) += (weighted.asDiagonal() * r.parameters.topRows(m)).real();
    s.slope.col(p) += weighted.cwiseProduct(r.dampings.topRows(m).rowwise().sum()).real();
  }
  for (Eigen::Index i = 0; i < m; ++i)
    if (square[i] > 0)
      s.slope.row(i) /= square[i];
    else
      s.slope.row(i).setZero();
  return s;
}
}  // namespace mill::twin
