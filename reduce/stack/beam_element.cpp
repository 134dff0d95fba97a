#include "reduce/stack/beam_element.h"
#include <cmath>

namespace mill::reduce {
// Abramowitz, Stegun, Handbook of Mathematical Functions, table 25.4, on 0 .. 1.
const double UnitGauss::place[n]  = {0.5 - 0.5 * 0.906179845938664, 0.5 - 0.5 * 0.538469310105683, 0.5,
                                     0.5 + 0.5 * 0.538469310105683, 0.5 + 0.5 * 0.906179845938664};
const double UnitGauss::weight[n] = {0.5 * 0.236926885056189, 0.5 * 0.478628670499366, 0.5 * 0.568888888888889,
                                     0.5 * 0.478628670499366, 0.5 * 0.236926885056189};

Eigen::Vector4d BeamElement::shape(const double t) const
{
  const double P = shear_ratio, s = 1 / (1 + P), t2 = t * t, t3 = t2 * t;
  return {s * (1 - 3 * t2 + 2 * t3 + P * (1 - t)), s * length * (t - 2 * t2 + t3 + P * (t - t2) / 2),
          s * (3 * t2 - 2 * t3 + P * t), s * length * (t3 - t2 + P * (t2 - t) / 2)};
}

Eigen::Vector4d BeamElement::rotation(const double t) const
{
  const double P = shear_ratio, s = 1 / (1 + P), t2 = t * t;
  return {s * 6 * (t2 - t) / length, s * (1 - 4 * t + 3 * t2 + P * (1 - t)), s * 6 * (t - t2) / length,
          s * (3 * t2 - 2 * t + P * t)};
}

Eigen::Matrix4d BeamElement::stiffness() const
{
  const double L = length, P = shear_ratio;
  Eigen::Matrix4d K;
  K << 12, 6 * L, -12, 6 * L,                           //
      6 * L, (4 + P) * L * L, -6 * L, (2 - P) * L * L,  //
      -12, -6 * L, 12, -6 * L,                          //
      6 * L, (2 - P) * L * L, -6 * L, (4 + P) * L * L;
  return bending / ((1 + P) * L * L * L) * K;
}

Eigen::Matrix4d BeamElement::mass_matrix() const
{
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  for (int g = 0; g < UnitGauss::n; ++g) {
    const Eigen::Vector4d w = shape(UnitGauss::place[g]), r = rotation(UnitGauss::place[g]);
    M += UnitGauss::weight[g] * length * (mass * w * w.transpose() + rotary * r * r.transpose());
  }
  return M;
}
}  // namespace mill::reduce
