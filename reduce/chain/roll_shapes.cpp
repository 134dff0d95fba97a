#include "reduce/chain/roll_shapes.h"
#include "core/base/errors.h"
#include "reduce/chain/roll_body.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mill::reduce {
namespace {
/// Axis of a component displaced by q.
Deflection axis_of(const RollBody &roll, const Eigen::VectorXd &q)
{
  const RollShape axis{roll.axis_z, roll.axis * q};
  return [axis, kink = roll.half_barrel](const double x) { return value_at(axis, std::abs(x), kink); };
}
}  // namespace

double value_at(const RollShape &shape, const double x, const double kink)
{
  // Stations on the side of the kink that x lies on; the station at the kink belongs to both.
  const Eigen::VectorXd &z = shape.x;
  const double slack       = 1e-9 * z[z.size() - 1];
  Eigen::Index first = 0, last = z.size() - 1;
  if (x <= kink)
    last = std::upper_bound(z.begin(), z.end(), kink + slack) - z.begin() - 1;
  else
    first = std::lower_bound(z.begin(), z.end(), kink - slack) - z.begin();
  if (last - first < 1) {
    first = 0;
    last  = z.size() - 1;
  }
  const Eigen::Index n     = std::min<Eigen::Index>(4, last - first + 1);
  const Eigen::Index above = std::upper_bound(z.begin() + first, z.begin() + last + 1, x) - z.begin();
  const Eigen::Index begin = std::clamp<Eigen::Index>(above - n / 2, first, last - n + 1);
  double value             = 0;
  for (Eigen::Index i = begin; i < begin + n; ++i) {
    double weight = 1;
    for (Eigen::Index k = begin; k < begin + n; ++k)
      if (k != i)
        weight *= (x - z[k]) / (z[i] - z[k]);
    value += weight * shape.value[i];
  }
  return value;
}

BentBackupRoll::BentBackupRoll(const SteppedBeam &beam)
    : deflection([beam](const double x) { return reduce::deflection(beam, x); }), half_barrel(beam.half_barrel),
      half_span(beam.half_span), mid(mid_flexibility(beam)), mean(mean_flexibility(beam)),
      method("stepped Timoshenko beam")
{
}

BentBackupRoll::BentBackupRoll(const Component &solid, const double half_bearing_span)
    : half_barrel(solid.half_barrel), half_span(half_bearing_span), method("roll by finite elements")
{
  const RollBody roll  = component_roll(solid.name, solid);
  const Eigen::Index n = roll.K.rows();
  Eigen::Index seat;
  roll.seat.maxCoeff(&seat);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < n; ++i)
    if (i != seat)
      free.push_back(i);
  // An even load works on the mean, which is the coefficient of P_0: the first unknown.
  const Eigen::MatrixXd K = roll.K(free, free);
  const Eigen::VectorXd u = K.ldlt().solve(Eigen::VectorXd::Unit(n - 1, 0));
  Eigen::VectorXd q       = Eigen::VectorXd::Zero(n);
  q(free)                 = u;
  deflection              = axis_of(roll, q);
  mid                     = axis_row(roll, 0).dot(q);  // (22.13)
  mean                    = q[0];
}

double BentBackupRoll::flexibility(const MassReference reference) const
{
  return reference == MassReference::mean ? mean : mid;
}

BentBackupRoll times(BentBackupRoll roll, const double factor)
{
  roll.deflection = [factor, drawn = std::move(roll.deflection)](const double x) { return factor * drawn(x); };
  roll.mid *= factor;
  roll.mean *= factor;
  return roll;
}

BentWorkRoll::BentWorkRoll(const FoundationShape &foundation)
    : deflection([foundation](const double x) { return reduce::deflection(foundation, x); }),
      half_strip(foundation.roll.half_strip)
{
}

BentWorkRoll::BentWorkRoll(const Component &solid, const double strip, const double contact_stiffness)
    : half_strip(strip)
{
  if (!(contact_stiffness > 0 && strip > 0))
    throw InputError("work roll: strip width and contact stiffness must be positive");
  const RollBody roll        = component_roll(solid.name, solid);
  const LinePoints line      = line_points(roll, roll, roll.half_barrel),
                   under     = line_points(roll, roll, std::min(strip, roll.half_barrel));
  const Eigen::MatrixXd rows = barrel_rows(roll, line.z);
  const Eigen::MatrixXd K    = roll.K + contact_stiffness * rows.transpose() * line.share.asDiagonal() * rows;
  deflection                 = axis_of(roll, K.ldlt().solve(barrel_rows(roll, under.z).transpose() * under.share));
}
}  // namespace mill::reduce
