#include "reduce/bite/slab/hu_ehmann.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/curves.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>

namespace mill::bite {
namespace {
using Number = Dual<n_inputs>;

void require_neutral_point(const RollBite &bite, const HuEhmannContact<Number> &c, const double radius)
{
  if (c.neutral_share > 0 && c.neutral_share < 1)
    return;
  const Strip &s         = bite.strip;
  const bool beyond_exit = c.neutral_share <= 0;
  refuse_neutral_point(beyond_exit ? sentence("strip.friction.entry_factor = ", s.friction.entry_factor)
                                   : sentence("strip.friction.exit_factor = ", s.friction.exit_factor),
                       std::sqrt((s.entry_thickness - s.exit_thickness) / radius), std::abs(c.missing),
                       beyond_exit);
}

/// Pressure and friction stress, summed up from both ends between neighbouring points.
void sample(BiteState &state, const RollBite &bite, const PassInputs<double> &in, const HuEhmannContact<Number> &c,
            const int points)
{
  static const GaussRule rule = gauss_legendre(4);
  const Strip &s              = bite.strip;
  const double m_in = c.entry_factor.value, m_out = c.exit_factor.value,
               scale = std::sqrt(in.radius * in.exit_thickness);
  const int n_side   = std::max(points, 21);
  state.position =
      curve_positions(c.exit_position.value, c.neutral_position.value, c.entry_position.value, n_side);
  fill_curves(state, in, c.entry_speed.value);
  const Eigen::Index n = state.position.size(), middle = n_side - 1;
  state.pressure.resize(n);
  state.shear.resize(n);
  const auto change = [&](const double from, const double to, const double m) {  // of p - k
    double sum = 0;
    visit_arc(s, in, rule, std::atan(from / scale), std::atan(to / scale),
              [&](const double dx, const double x, const double h, const double k) {
                sum += k / h * (2 * x / in.radius + m * (1 + x * x / (in.radius * in.radius))) * dx;
              });
    return sum;
  };
  const auto yield = [&](const Eigen::Index i) {
    return stress_at(s.flow_stress, in, std::min(state.thickness[i], in.entry_thickness));
  };
  double sum = -in.exit_tension;
  for (Eigen::Index i = 0; i <= middle; ++i) {
    if (i > 0)
      sum += change(state.position[i - 1], state.position[i], m_out);
    state.pressure[i] = yield(i) + sum;
    state.shear[i]    = -0.5 * m_out * yield(i);
  }
  sum = -in.entry_tension;
  for (Eigen::Index i = n - 1; i > middle; --i) {
    if (i < n - 1)
      sum += change(state.position[i + 1], state.position[i], -m_in);
    state.pressure[i] = yield(i) + sum;
    state.shear[i]    = 0.5 * m_in * yield(i);
  }
  state.shear[middle] = 0;
  state.peak_pressure = state.pressure.maxCoeff();
  if (points < 2)
    for (Eigen::VectorXd *curve : {&state.position, &state.thickness, &state.pressure, &state.shear, &state.slip})
      curve->resize(0);
}
}  // namespace

BiteState solve_hu_ehmann(const RollBite &bite, const Arc arc, const int curve_points)
{
  check_pass(bite);
  check_factors(bite);
  if (arc == Arc::elastic)
    throw InputError("the theory of Hu and Ehmann is closed on circular arcs only; take the Karman slab for an "
                     "elastic arc");
  const Strip &s         = bite.strip;
  const HillRules &rules = hill_rules(bite);
  const Integration how  = hardens(s.flow_stress) ? Integration::quadrature : Integration::closed;
  BiteState state;
  state.model            = arc == Arc::rigid ? "Hu-Ehmann slab, rigid arc" : "Hu-Ehmann slab, Hitchcock's arc";
  state.flattened_radius = bite.roll_radius;
  double speed = (std::isnan(bite.roll_speed) ? 1 : bite.roll_speed) * s.exit_thickness / s.entry_thickness;
  if (arc == Arc::hitchcock) {
    const auto flattened   = flattened_arc(bite, [&](const double radius) {
      return hu_ehmann_state(bite, pass_inputs<double>(bite, radius), speed, rules, how).force;
    });
    state.flattened_radius = flattened.radius;
    state.iterations       = flattened.evaluations;
  }
  const double R = state.flattened_radius;
  const auto in  = pass_inputs<double>(bite, R);
  const auto d   = hu_ehmann_state(bite, differentiable_inputs(bite, R), speed, rules, how);
  const auto &c  = d.contact;
  require_neutral_point(bite, c, R);
  state.force             = d.force.value;
  state.torque            = d.torque.value;
  state.friction          = 0.5 * (c.entry_factor.value + c.exit_factor.value);
  state.arc_length        = c.entry_position.value;
  state.exit_position     = c.exit_position.value;
  state.bite_angle        = state.arc_length / R;
  state.neutral_position  = c.neutral_position.value;
  state.neutral_thickness = in.exit_thickness + state.neutral_position * state.neutral_position / R;
  state.forward_slip      = c.exit_speed.value / in.roll_speed - 1;
  state.entry_flow_stress = stress_at(s.flow_stress, in, in.entry_thickness);
  state.exit_flow_stress  = stress_at(s.flow_stress, in, c.exit_thickness.value);
  state.largest_shear     = std::max(c.entry_factor.value, c.exit_factor.value);
  if (s.friction.entry_factor == 1)
    state.sticking_length += state.arc_length - state.neutral_position;
  if (s.friction.exit_factor == 1)
    state.sticking_length += state.neutral_position - state.exit_position;
  state.force_by  = d.force.by;
  state.torque_by = d.torque.by;
  forget_unknown_speeds(bite, state);
  if (!std::isnan(bite.roll_speed)) {
    state.entry_speed = c.entry_speed.value;
    state.exit_speed  = c.exit_speed.value;
  }
  const double F_h = by(state.force_by, Input::exit_thickness), F_R = by(state.force_by, Input::arc_radius);
  state.force_by_exit_following = arc == Arc::rigid ? F_h : following_slope(bite, state.force, F_h, F_R);
  sample(state, bite, in, c, curve_points);
  state.notes = range_notes(bite, state, INFINITY);
  return state;
}

double published_hu_ehmann_force(const double R, const double h_in, const double h_c, const double sigma_in,
                                 const double sigma_out, const double tau, const double m_in, const double m_out,
                                 const double x_out)
{
  const double x_in = std::sqrt(R * (h_in - h_c)), h_out = h_c + x_out * x_out / R, scale = std::sqrt(R * h_c);
  const auto B = [&](const double x) { return std::sqrt(R / h_c) * std::atan(x / scale); };
  const double B_n =
      (m_in * B(x_in) + m_out * B(x_out) + (sigma_out - sigma_in) / (2 * tau) - std::log(h_in / h_out)) /
      (m_in + m_out);
  const double x_n = scale * std::tan(B_n * std::sqrt(h_c / R)), h_n = h_c + x_n * x_n / R;
  return (2 * tau + sigma_in) * (x_out - x_in) +
         tau / R * (m_out * (x_out * x_out - x_n * x_n) + m_in * (x_in * x_in - x_n * x_n)) +
         tau * R * (m_out * std::log(h_out / h_n) + m_in * std::log(h_in / h_n)) +
         2 * tau * x_out * std::log(h_in / h_out) + 2 * tau * (m_in + m_out) * x_out * B_n +
         (4 * tau * scale - 2 * tau * m_in * x_out * std::sqrt(R / h_c)) * std::atan(x_in / scale) -
         (4 * tau * scale + 2 * tau * m_out * x_out * std::sqrt(R / h_c)) * std::atan(x_out / scale);
}
}  // namespace mill::bite
