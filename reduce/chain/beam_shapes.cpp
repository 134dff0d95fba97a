#include "reduce/chain/beam_shapes.h"
#include "core/model/four_high.h"
#include "core/model/roll.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
/// cosh cos, sinh sin, cosh sin, sinh cos of the argument u, and their derivatives over u.
/// Each derivative is a pair of the four again, so the rows follow from one another: (4.9).
Eigen::RowVector4d foundation_functions(const double u, const int derivative)
{
  const double C = std::cosh(u), S = std::sinh(u), c = std::cos(u), s = std::sin(u);
  const Eigen::RowVector4d f(C * c, S * s, C * s, S * c);
  Eigen::Matrix4d next;  // d/du f = f * next
  next << 0, 0, 1, 1,    // (cosh sin)' = sinh sin + cosh cos,  (sinh cos)' = cosh cos - sinh sin
      0, 0, 1, -1,       //
      -1, 1, 0, 0,       // (cosh cos)' = sinh cos - cosh sin,  (sinh sin)' = cosh sin + sinh cos
      1, 1, 0, 0;
  Eigen::RowVector4d value = f;
  for (int i = 0; i < derivative; ++i)
    value = value * next;
  return value;
}
}  // namespace

BeamSection beam_section(const RoundSection &section, const Material &m)
{
  const double G = m.youngs_modulus / (2 * (1 + m.poisson_ratio));
  return {m.youngs_modulus * second_moment_of(section), shear_factor_of(section) * G * area_of(section)};
}

BeamSection round_section(const double diameter, const Material &m)
{
  return beam_section({diameter}, m);
}

SteppedBeam backup_beam(const FourHigh &stand)
{
  const Roll &roll = stand.backup_roll;
  const double h   = roll.barrel_length / 2;
  return {roll.bearing_span / 2, h, h, beam_section(barrel_section(roll), stand.steel),
          beam_section(neck_section(roll), stand.steel)};
}

double deflection_from_middle(const SteppedBeam &beam, const double position)
{
  const double a = beam.half_span, c = beam.half_load, h = beam.half_barrel;
  const double x = std::abs(position);
  // Under the load, (4.4): bending D with slope t, shear S.
  const double x1 = std::min(x, c);
  double D        = ((2 * a - c) * x1 * x1 / 8 - x1 * x1 * x1 * x1 / (48 * c)) / beam.barrel.bending;
  double t        = ((2 * a - c) * x1 / 4 - x1 * x1 * x1 / (12 * c)) / beam.barrel.bending;
  double S        = x1 * x1 / (4 * c * beam.barrel.shear);
  // Beyond the load, zone from x0 to x1, (4.5): the moment is (a - x)/2, the shear force 1/2.
  const auto zone = [&](const double x0, const double end, const BeamSection &section) {
    const double s = end - x0;
    D += t * s + (a * s * s / 4 - (end * end * end - 3 * x0 * x0 * end + 2 * x0 * x0 * x0) / 12) / section.bending;
    t += (a * s / 2 - (end * end - x0 * x0) / 4) / section.bending;
    S += s / (2 * section.shear);
  };
  if (x > c)
    zone(c, std::min(x, h), beam.barrel);
  if (x > h)
    zone(h, x, beam.neck);
  return D + S;
}

double deflection(const SteppedBeam &beam, const double x)
{
  return deflection_from_middle(beam, beam.half_span) - deflection_from_middle(beam, x);
}

double mid_flexibility(const SteppedBeam &beam)
{
  return deflection_from_middle(beam, beam.half_span);
}

double mean_flexibility(const SteppedBeam &beam)
{
  // Under the load that deflection is the polynomial (4.4); its mean is exact.
  const double a = beam.half_span, c = beam.half_load;
  const double bending = ((2 * a - c) * c * c / 24 - std::pow(c, 3) / 240) / beam.barrel.bending;
  const double shear   = c / (12 * beam.barrel.shear);
  return mid_flexibility(beam) - bending - shear;
}

FoundationShape foundation_shape(const BarrelOnFoundation &roll)
{
  const double k = roll.foundation_stiffness, h = roll.half_barrel, s = roll.half_strip;
  if (!(k > 0 && h > 0 && s > 0 && roll.bending > 0))
    throw InputError("work roll: barrel length, strip width, contact stiffness and diameter must be positive");
  FoundationShape shape;
  shape.roll        = roll;
  shape.wave_number = std::pow(k / (4 * roll.bending), 0.25);
  if (s >= h) {
    shape.end_deflection = 1 / (2 * h * k);
    return shape;
  }
  // w and its first three derivatives continue at the strip edge; no moment and no shear force at the barrel end,
  // (4.10).
  Eigen::Matrix<double, 6, 6> condition = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right     = Eigen::Matrix<double, 6, 1>::Zero();
  for (int order = 0; order < 4; ++order) {
    const Eigen::RowVector4d at_strip = foundation_functions(shape.wave_number * s, order);
    condition.block<1, 2>(order, 0)   = at_strip.head<2>();
    condition.block<1, 4>(order, 2)   = -at_strip;
  }
  condition.block<1, 4>(4, 2) = foundation_functions(shape.wave_number * h, 2);
  condition.block<1, 4>(5, 2) = foundation_functions(shape.wave_number * h, 3);
  right[0]                    = -1 / (2 * s * k);
  shape.constant              = condition.fullPivLu().solve(right);
  const Eigen::Vector4d outer = shape.constant.tail<4>();
  shape.end_deflection        = foundation_functions(shape.wave_number * h, 0).dot(outer);
  shape.end_slope             = shape.wave_number * foundation_functions(shape.wave_number * h, 1).dot(outer);
  return shape;
}

double deflection(const FoundationShape &shape, const double position)
{
  const BarrelOnFoundation &roll = shape.roll;
  const double x                 = std::abs(position);
  if (x > roll.half_barrel)
    return shape.end_deflection + (x - roll.half_barrel) * shape.end_slope;
  if (roll.half_strip >= roll.half_barrel)
    return shape.end_deflection;
  const Eigen::RowVector4d f = foundation_functions(shape.wave_number * x, 0);
  if (x <= roll.half_strip)
    return 1 / (2 * roll.half_strip * roll.foundation_stiffness) + f.head<2>().dot(shape.constant.head<2>());
  return f.dot(shape.constant.tail<4>());
}
}  // namespace mill::reduce
