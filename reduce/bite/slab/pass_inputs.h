#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/numerics/derivative.h"
#include "reduce/bite/bite.h"
#include <algorithm>
#include <vector>

namespace mill::bite {
/// The numbers by which a closed theory can be differentiated, in the order of Input.  T is double, complex or
/// Dual.
template <class T> struct PassInputs {
  T entry_thickness, exit_thickness;  ///< m
  T entry_tension, exit_tension;      ///< Pa
  T friction;                         ///< -, added to Coulomb's mu, or to both factors
  T flow_stress;                      ///< -, factor on k_f
  T radius;                           ///< m, of the arc
  T roll_speed, gap_rate;             ///< m/s
  T initial_thickness;                ///< m, where the strain is zero; goes with the entry where it is not given
};

template <class T> T &input(PassInputs<T> &in, const Input which)
{
  T *const members[] = {&in.entry_thickness, &in.exit_thickness, &in.entry_tension, &in.exit_tension, &in.friction,
                        &in.flow_stress,     &in.radius,         &in.roll_speed,    &in.gap_rate};
  return *members[static_cast<int>(which)];
}

/// Of a bite on an arc of the given radius.  A roll speed that is not given is taken as 1 m/s: a theory without
/// film and with a gap at rest gives speeds over that of the roll.
template <class T> PassInputs<T> pass_inputs(const RollBite &bite, const double radius)
{
  const Strip &s = bite.strip;
  return {s.entry_thickness,
          s.exit_thickness,
          s.entry_tension,
          s.exit_tension,
          0.0,
          1.0,
          radius,
          std::isnan(bite.roll_speed) ? 1.0 : bite.roll_speed,
          bite.gap_rate,
          std::isnan(s.initial_thickness) ? s.entry_thickness : s.initial_thickness};
}

/// With the reference of the strain following the entry thickness where it is not given.
template <class T> void follow_entry(const RollBite &bite, PassInputs<T> &in)
{
  if (std::isnan(bite.strip.initial_thickness))
    in.initial_thickness = in.entry_thickness;
}

/// Every input a direction of differentiation.
inline PassInputs<Dual<n_inputs>> differentiable_inputs(const RollBite &bite, const double radius)
{
  auto in = pass_inputs<Dual<n_inputs>>(bite, radius);
  for (int i = 0; i < n_inputs; ++i)
    input(in, Input(i)).by[i] = 1;
  follow_entry(bite, in);
  return in;
}

/// The values in another number type, without derivatives.
template <class To, class T> PassInputs<To> values_as(PassInputs<T> in)
{
  PassInputs<To> out;
  for (int i = 0; i < n_inputs; ++i)
    input(out, Input(i)) = value_of(input(in, Input(i)));
  out.initial_thickness = value_of(in.initial_thickness);
  return out;
}

/// One input with an imaginary part of `step` (complex step), to check the derivatives.
inline PassInputs<std::complex<double>> complex_inputs(const RollBite &bite, const double radius,
                                                       const Input which, const double step)
{
  auto in = pass_inputs<std::complex<double>>(bite, radius);
  input(in, which) += std::complex<double>(0, step);
  follow_entry(bite, in);
  return in;
}

/// k_f at a thickness, (8.1).
template <class Law, class T> T stress_at(const Law &law, const PassInputs<T> &in, const T &thickness)
{
  using std::log;
  return in.flow_stress * flow_stress(law, T(log(in.initial_thickness / thickness)));
}

/// 1 - tension / flow stress; without tension it is one even where an unhardened strip has no flow stress at all.
template <class T> T tension_factor(const T &tension, const T &stress)
{
  return value_of(tension) == 0 && value_of(stress) == 0 ? T(1.0) : 1.0 - tension / stress;
}

/// Exit abscissa of a moving gap, m: where the strip stops getting thinner, (8.16).
/// Never a division by the gap rate, so a gap at rest needs no special case.
template <class T> T exit_position(const PassInputs<T> &in, const T &entry_position, const T &entry_speed)
{
  using std::sqrt;
  const T flow = entry_speed * in.entry_thickness - entry_position * in.gap_rate;
  const T lag  = in.radius * in.exit_thickness * in.gap_rate;
  return lag / (flow + sqrt(flow * flow + lag * in.gap_rate));
}

/// Speed of the strip at the entry, m/s, from the neutral point, (8.15).
template <class T> T entry_speed_at(const PassInputs<T> &in, const T &entry_position, const T &neutral_position)
{
  return (in.roll_speed * (in.exit_thickness + neutral_position * neutral_position / in.radius) +
          (entry_position - neutral_position) * in.gap_rate) /
         in.entry_thickness;
}

/// Speed of the strip at x, m/s, from that at the entry, (8.15).
template <class T>
T strip_speed(const PassInputs<T> &in, const T &entry_speed, const T &entry_position, const T &x)
{
  return (entry_speed * in.entry_thickness + (x - entry_position) * in.gap_rate) /
         (in.exit_thickness + x * x / in.radius);
}

/// Angles t of x = sqrt(R h_d) tan t at which the flow stress has a kink (rows of a table) or its curvature jumps
/// (growth()), between `from` and `to`, with both ends.
template <class Law, class T>
std::vector<T> smooth_pieces(const Law &law, const PassInputs<T> &in, const T &from, const T &to)
{
  using std::atan;
  using std::sqrt;
  std::vector<T> angles{from};
  std::vector<T> inside;
  const auto cut = [&](const double strain) {
    const T h = in.initial_thickness * std::exp(-strain);
    if (!std::isfinite(strain) || value_of(h) <= value_of(in.exit_thickness))
      return;
    const T angle = atan(sqrt(h / in.exit_thickness - 1.0));
    for (const T &t : {angle, -angle})  // a closing gap ends behind the line of centres
      if (value_of(t) > value_of(from) && value_of(t) < value_of(to))
        inside.push_back(t);
  };
  for (const double strain : strains_of_kinks(law))
    cut(strain);
  std::sort(inside.begin(), inside.end(), [](const T &a, const T &b) { return value_of(a) < value_of(b); });
  angles.insert(angles.end(), inside.begin(), inside.end());
  angles.push_back(to);
  return angles;
}

}  // namespace mill::bite
