#pragma once
#include "core/laws/friction_law.h"
#include "reduce/bite/quadrature.h"
#include "reduce/bite/slab/pass_inputs.h"
#include "reduce/bite/slab/settle.h"

// Bland and Ford's slab with hardening, tensions, a lubricant and a moving gap, written once for any number type.
// theory.md 8.2, 8.3, 8.7
namespace mill::bite {
/// Contact of a state, in the angle t of  x = sqrt(R h_d) tan t,  in which h = h_d / cos^2 t, (8.3).
template <class T> struct BlandFordContact {
  T entry_position, neutral_position, exit_position;  ///< m
  T entry_angle, neutral_angle, exit_angle;           ///< t there
  T entry_factor, exit_factor;                        ///< -, 1 - tension / flow stress at both ends
  T exit_thickness;                                   ///< m, where the contact ends
  T friction;                                         ///< -, Coulomb's mu
  T film;                                             ///< m, film law only
  T entry_speed, exit_speed;                          ///< m/s, that follow from this neutral point
  double free_neutral_angle =
      0;               ///< rad, before it is kept inside the arc: shows that a neutral point does not exist
  double balance = 0;  ///< -, Lambda of (8.7)
};

/// Hardening and friction of a strip with constants that can be differentiated.
template <class T> struct StripLaws {
  FlowStressOf<T> flow_stress;
  FrictionOf<T> friction;
};

template <class T> StripLaws<T> strip_laws(const Strip &strip)
{
  return {flow_stress_in<T>(strip.flow_stress), friction_in<T>(strip.friction)};
}

/// What is held while a state is linearised.
template <class T> struct Held {
  const T *exit_speed = nullptr;  ///< in the film law
  const T *friction   = nullptr;
};

/// Contact for a speed of the strip at the entry, which enters the film and the exit point only.
/// @param strip  Strip, or StripLaws<T> where the constants of its laws are differentiated too
template <class Laws, class T>
BlandFordContact<T> bland_ford_contact(const Laws &strip, const PassInputs<T> &in, const T &entry_speed,
                                       const Held<T> &held = {})
{
  using std::atan;
  using std::log;
  using std::sqrt;
  using std::tan;
  BlandFordContact<T> c;
  const T scale        = sqrt(in.radius * in.exit_thickness);
  const T entry_stress = stress_at(strip.flow_stress, in, in.entry_thickness);
  c.entry_position     = sqrt(in.radius * (in.entry_thickness - in.exit_thickness));  // (8.2)
  c.exit_position      = exit_position(in, c.entry_position, entry_speed);
  c.exit_thickness     = in.exit_thickness + c.exit_position * c.exit_position / in.radius;
  c.entry_angle        = atan(c.entry_position / scale);
  c.exit_angle         = atan(c.exit_position / scale);
  c.entry_factor       = tension_factor(in.entry_tension, entry_stress);
  c.exit_factor        = tension_factor(in.exit_tension, stress_at(strip.flow_stress, in, c.exit_thickness));
  const T film_exit_speed =
      held.exit_speed ? *held.exit_speed : strip_speed(in, entry_speed, c.entry_position, c.exit_position);
  const Inlet<T> inlet{in.roll_speed, entry_speed,      film_exit_speed,
                       in.radius,     c.entry_position, entry_stress - in.entry_tension};
  const Coefficient<T> law = coefficient_at(strip.friction, inlet);
  c.film                   = law.film;
  c.friction               = in.friction + (held.friction ? *held.friction : law.mu);
  const T balance          = log(c.exit_factor / c.entry_factor * in.entry_thickness / c.exit_thickness);  // (8.7)
  c.neutral_angle =
      0.5 * (c.entry_angle + c.exit_angle) - sqrt(in.exit_thickness / in.radius) * balance / (4.0 * c.friction);
  c.balance            = value_of(balance);
  c.free_neutral_angle = value_of(c.neutral_angle);
  if (c.free_neutral_angle <= value_of(c.exit_angle))
    c.neutral_angle = c.exit_angle;
  if (c.free_neutral_angle >= value_of(c.entry_angle))
    c.neutral_angle = c.entry_angle;
  c.neutral_position = scale * tan(c.neutral_angle);
  c.entry_speed      = entry_speed_at(in, c.entry_position, c.neutral_position);
  c.exit_speed       = strip_speed(in, c.entry_speed, c.entry_position, c.exit_position);
  return c;
}

/// Pressure, Pa: (8.5) on the entry side, (8.6) on the exit side.
template <class Laws, class T>
T bland_ford_pressure(const Laws &strip, const PassInputs<T> &in, const BlandFordContact<T> &c, const T &angle,
                      const bool entry_side)
{
  using std::cos;
  using std::exp;
  using std::sqrt;
  const T h         = in.exit_thickness / (cos(angle) * cos(angle));
  const T per_angle = 2.0 * c.friction * sqrt(in.radius / in.exit_thickness);  // mu dH/dt
  return entry_side ? c.entry_factor * stress_at(strip.flow_stress, in, h) * h / in.entry_thickness *
                          exp(per_angle * (c.entry_angle - angle))
                    : c.exit_factor * stress_at(strip.flow_stress, in, h) * h / c.exit_thickness *
                          exp(per_angle * (angle - c.exit_angle));
}

/// Force per width on both sides of the neutral point, N/m.
template <class T> struct SidesOfHill {
  T entry, exit;
};

/// Integrals of the pressure from x_d to x_n and from x_n to x_e, (8.8), by Gauss-Legendre in t.
template <class Laws, class T>
SidesOfHill<T> bland_ford_force(const Laws &strip, const PassInputs<T> &in, const BlandFordContact<T> &c,
                                const HillRules &rules)
{
  using std::cos;
  using std::exp;
  using std::sqrt;
  const T per_angle = 2.0 * c.friction * sqrt(in.radius / in.exit_thickness);
  const T scale     = in.exit_thickness * sqrt(in.radius * in.exit_thickness);
  const auto side   = [&](const T &from, const T &to, const bool entry_side) {
    T sum(0.0);
    const GaussRule &rule = entry_side ? rules.entry_side : rules.exit_side;
    const auto piece      = [&](const T &a, const T &b) {
      const T middle = 0.5 * (a + b), half = 0.5 * (b - a);
      T part(0.0);
      for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
        const T t      = middle + half * rule.node[i];
        const T cosine = cos(t), square = cosine * cosine;  // h = h_d / square, dx = sqrt(R h_d) / square dt
        const T stress = stress_at(strip.flow_stress, in, T(in.exit_thickness / square));
        part += rule.weight[i] * stress / (square * square) *
                exp(per_angle * (entry_side ? c.entry_angle - t : t - c.exit_angle));
      }
      sum += half * part;
    };
    const std::vector<T> angles = smooth_pieces(strip.flow_stress, in, from, to);
    for (std::size_t p = 1; p < angles.size(); ++p)
      piece(angles[p - 1], angles[p]);
    return sum;
  };
  return {c.entry_factor / in.entry_thickness * scale * side(c.neutral_angle, c.entry_angle, true),
          c.exit_factor / c.exit_thickness * scale * side(c.exit_angle, c.neutral_angle, false)};
}

/// Contact in which film, exit point and speeds agree.  `entry_speed` is the start and returns the result, m/s.
/// @param laws  the strip, or its laws in T
/// @throws SolverError  they do not settle
template <class Laws, class T>
BlandFordContact<T> settled_bland_ford(const Strip &strip, const Laws &laws, const PassInputs<T> &in,
                                       double &entry_speed)
{
  return settled_contact(in, entry_speed, [&](const auto &inputs, const auto &speed) {
    if constexpr (std::is_same_v<std::decay_t<decltype(speed)>, T>)
      return bland_ford_contact(laws, inputs, speed);
    else
      return bland_ford_contact(strip, inputs, speed);  // plain numbers on the way to the root
  });
}
template <class T>
BlandFordContact<T> settled_bland_ford(const Strip &strip, const PassInputs<T> &in, double &entry_speed)
{
  return settled_bland_ford(strip, strip, in, entry_speed);
}
}  // namespace mill::bite
