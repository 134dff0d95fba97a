#pragma once
#include "reduce/bite/quadrature.h"
#include "reduce/bite/slab/pass_inputs.h"
#include "reduce/bite/slab/settle.h"

// Slab theory with friction factors after Hu and Ehmann, exact, written once for any number type.  theory.md 8.8
namespace mill::bite {
/// How the integrals over the arc are taken.
enum class Integration {
  closed,     ///< exact antiderivatives; flow stress constant
  quadrature  ///< Gauss-Legendre in t; any flow stress
};

template <class T> struct HuEhmannContact {
  T entry_position, neutral_position, exit_position;  ///< m
  T exit_thickness;                                   ///< m, where the contact ends
  T entry_factor, exit_factor;                        ///< -, friction stress over shear yield stress
  T entry_speed, exit_speed;                          ///< m/s, that follow from this neutral point
  double neutral_share = 0;  ///< -, friction to the neutral point over that of the arc; outside 0..1 there is none
  double missing       = 0;  ///< -, tensions and thinning over the friction of the whole arc at a factor of one
};

/// Antiderivatives in x for a constant flow stress, all of h = h_c + x^2/R.
template <class T> struct ParabolaIntegrals {
  T log_ratio;    ///< -, ln(h/h_c)
  T friction;     ///< -, of (1 + x^2/R^2)/h, (8.25)
  T of_log;       ///< m, of ln(h/h_c)
  T of_friction;  ///< m, of the one before
};

template <class T> ParabolaIntegrals<T> parabola_integrals(const PassInputs<T> &in, const T &x)
{
  using std::atan;
  using std::sqrt;
  const T &R = in.radius, &h_c = in.exit_thickness;
  const T B     = sqrt(R / h_c) * atan(x / sqrt(R * h_c));
  const T ratio = log1p(x * x / (R * h_c));
  const T share = 1.0 - h_c / R;
  return {ratio, share * B + x / R, x * ratio - 2.0 * x + 2.0 * h_c * B,
          share * (x * B - 0.5 * R * ratio) + x * x / (2.0 * R)};
}

/// Visits the points of a quadrature over x from angle a to b: visit(dx, x, h, k).  Split at the kinks of a table.
template <class T, class Visit>
void visit_arc(const Strip &strip, const PassInputs<T> &in, const GaussRule &rule, const T &a, const T &b,
               const Visit &visit)
{
  using std::cos;
  using std::sqrt;
  using std::tan;
  const T scale    = sqrt(in.radius * in.exit_thickness);
  const auto piece = [&](const T &from, const T &to) {
    const T middle = 0.5 * (from + to), half = 0.5 * (to - from) * scale / in.exit_thickness;
    for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
      const T tangent = tan(middle + 0.5 * (to - from) * rule.node[i]);
      const T h       = in.exit_thickness * (1.0 + tangent * tangent);
      visit(T(rule.weight[i] * half * h), T(scale * tangent), h, stress_at(strip.flow_stress, in, h));
    }
  };
  const std::vector<T> angles = smooth_pieces(strip.flow_stress, in, a, b);
  for (std::size_t p = 1; p < angles.size(); ++p)
    piece(angles[p - 1], angles[p]);
}

/// Friction at a factor of one and thinning between two angles, Pa: integrals of k (1 + x^2/R^2)/h and k h'/h.
template <class T> struct ArcWork {
  T friction, thinning;
};

template <class T>
ArcWork<T> arc_work(const Strip &strip, const PassInputs<T> &in, const GaussRule &rule, const T &a, const T &b,
                    const Integration how)
{
  using std::log;
  using std::sqrt;
  using std::tan;
  if (how == Integration::closed) {
    const T scale = sqrt(in.radius * in.exit_thickness);
    const auto p = parabola_integrals(in, T(scale * tan(a))), q = parabola_integrals(in, T(scale * tan(b)));
    const T k = stress_at(strip.flow_stress, in, in.exit_thickness);
    return {k * (q.friction - p.friction), k * (q.log_ratio - p.log_ratio)};
  }
  ArcWork<T> work{T(0.0), T(0.0)};
  visit_arc(strip, in, rule, a, b, [&](const T &dx, const T &x, const T &h, const T &k) {
    const T part = k / h * dx;
    work.friction += part * (1.0 + x * x / (in.radius * in.radius));
    work.thinning += part * x * (2.0 / in.radius);
  });
  return work;
}

/// Contact for a speed of the strip at the entry, which places the exit of a moving gap.
template <class T>
HuEhmannContact<T> hu_ehmann_contact(const Strip &strip, const PassInputs<T> &in, const T &entry_speed,
                                     const HillRules &rules, const Integration how)
{
  using std::atan;
  using std::log;
  using std::sqrt;
  using std::tan;
  const T &R    = in.radius;
  const T scale = sqrt(R * in.exit_thickness);
  HuEhmannContact<T> c;
  c.entry_position = sqrt(R * (in.entry_thickness - in.exit_thickness));
  c.exit_position  = exit_position(in, c.entry_position, entry_speed);
  c.exit_thickness = in.exit_thickness + c.exit_position * c.exit_position / R;
  c.entry_factor   = strip.friction.entry_factor + in.friction;
  c.exit_factor    = strip.friction.exit_factor + in.friction;
  const T t_exit = atan(c.exit_position / scale), t_entry = atan(c.entry_position / scale);

  // In plain numbers: the angle up to which the friction amounts to (8.26).
  const auto plain_inputs = values_as<double>(in);
  const double from = value_of(t_exit), to = value_of(t_entry);
  const double m_in = value_of(c.entry_factor), m_out = value_of(c.exit_factor);
  const auto arc      = arc_work(strip, plain_inputs, rules.entry_side, from, to, how);
  const double pull   = plain_inputs.exit_tension - plain_inputs.entry_tension - arc.thinning;
  const double wanted = (m_in * arc.friction + pull) / (m_in + m_out);
  c.neutral_share     = wanted / arc.friction;
  c.missing           = pull / arc.friction;
  const auto rate_at  = [&](const auto &inputs, const double angle) {  // of the friction by the angle
    const auto tangent = std::tan(angle);
    const auto h       = inputs.exit_thickness * (1 + tangent * tangent);
    return stress_at(strip.flow_stress, inputs, h) *
           (1.0 + inputs.exit_thickness / inputs.radius * (tangent * tangent)) *
           sqrt(inputs.radius / inputs.exit_thickness);
  };
  T t = c.neutral_share <= 0 ? t_exit : t_entry;
  if (c.neutral_share > 0 && c.neutral_share < 1) {
    double t0 = from + (to - from) * c.neutral_share;
    for (int step = 0; step < 30; ++step) {
      const double change = (wanted - arc_work(strip, plain_inputs, rules.exit_side, from, t0, how).friction) /
                            rate_at(plain_inputs, t0);
      t0 = std::min(std::max(t0 + change, from), to);
      if (std::abs(change) <= 1e-14)
        break;
    }
    // One step in T carries the derivatives.
    const ArcWork<T> behind = arc_work(strip, in, rules.exit_side, t_exit, T(t0), how),
                     before = arc_work(strip, in, rules.entry_side, T(t0), t_entry, how);
    const T whole           = behind.friction + before.friction;
    const T target =
        (c.entry_factor * whole + in.exit_tension - in.entry_tension - behind.thinning - before.thinning) /
        (c.entry_factor + c.exit_factor);
    t = t0 + (target - behind.friction) / rate_at(in, t0);
  }
  c.neutral_position = scale * tan(t);
  c.entry_speed      = entry_speed_at(in, c.entry_position, c.neutral_position);
  c.exit_speed       = strip_speed(in, c.entry_speed, c.entry_position, c.exit_position);
  return c;
}

/// Force per width and friction force per width of both sides of the neutral point, N/m.
template <class T> struct HuEhmannSides {
  T entry, exit, entry_friction, exit_friction;
};

template <class T>
HuEhmannSides<T> hu_ehmann_force(const Strip &strip, const PassInputs<T> &in, const HuEhmannContact<T> &c,
                                 const HillRules &rules, const Integration how)
{
  using std::atan;
  using std::sqrt;
  const T &R = in.radius, &x_n = c.neutral_position;
  const T behind = x_n - c.exit_position, before = c.entry_position - x_n;
  if (how == Integration::closed) {
    const T k    = stress_at(strip.flow_stress, in, in.exit_thickness);
    const auto e = parabola_integrals(in, c.entry_position), n = parabola_integrals(in, x_n),
               d = parabola_integrals(in, c.exit_position);
    return {(k - in.entry_tension) * before - k * (e.log_ratio * before - (e.of_log - n.of_log)) +
                c.entry_factor * k * (e.friction * before - (e.of_friction - n.of_friction)),
            (k - in.exit_tension) * behind + k * (n.of_log - d.of_log - d.log_ratio * behind) +
                c.exit_factor * k * (n.of_friction - d.of_friction - d.friction * behind),
            0.5 * c.entry_factor * k * before, 0.5 * c.exit_factor * k * behind};
  }
  // Integrated by parts: what happens at x acts on the arc between x and the neutral point.
  const T scale = sqrt(R * in.exit_thickness);
  const T t_d = atan(c.exit_position / scale), t_n = atan(x_n / scale), t_e = atan(c.entry_position / scale);
  HuEhmannSides<T> sides{T(0.0), T(0.0), T(0.0), T(0.0)};
  visit_arc(strip, in, rules.entry_side, t_n, t_e, [&](const T &dx, const T &x, const T &h, const T &k) {
    const T slope = k / h * (2.0 * x / R - c.entry_factor * (1.0 + x * x / (R * R)));  // of p without that of k
    sides.entry += (k - in.entry_tension - (x - x_n) * slope) * dx;
    sides.entry_friction += 0.5 * c.entry_factor * k * dx;
  });
  visit_arc(strip, in, rules.exit_side, t_d, t_n, [&](const T &dx, const T &x, const T &h, const T &k) {
    const T slope = k / h * (2.0 * x / R + c.exit_factor * (1.0 + x * x / (R * R)));
    sides.exit += (k - in.exit_tension + (x_n - x) * slope) * dx;
    sides.exit_friction += 0.5 * c.exit_factor * k * dx;
  });
  return sides;
}

template <class T> struct HuEhmannState {
  HuEhmannContact<T> contact;
  T force;   ///< N
  T torque;  ///< N m, one roll
};

/// @param entry_speed  m/s, start of the iteration and its result
template <class T>
HuEhmannState<T> hu_ehmann_state(const RollBite &bite, const PassInputs<T> &in, double &entry_speed,
                                 const HillRules &rules, const Integration how)
{
  HuEhmannState<T> s;
  s.contact        = settled_contact(in, entry_speed, [&](const auto &inputs, const auto &speed) {
    return hu_ehmann_contact(bite.strip, inputs, speed, rules, how);
  });
  const auto sides = hu_ehmann_force(bite.strip, in, s.contact, rules, how);
  s.force          = bite.strip.width * (sides.entry + sides.exit);
  s.torque         = bite.strip.width * bite.roll_radius * (sides.entry_friction - sides.exit_friction);
  return s;
}
}  // namespace mill::bite
