#include "reduce/bite/fit/fit_model.h"
#include "core/base/errors.h"
#include "core/laws/scaled_friction.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/karman_arc.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mill::bite {
namespace {
using Role = FitUnknown::Role;

// Friction, flow stress and radius of the arc among the directions of a Slope.
constexpr int mu_at = int(Input::friction), k_at = int(Input::flow_stress), R_at = int(Input::arc_radius);

/// What the friction law gives, by coefficient, flow stress, radius, and by its own constants.
constexpr int first_constant = 3;
using LawNumber              = Dual<first_constant + int(n_friction_constants)>;

LawNumber number_of_bite(const Slope &x)
{
  LawNumber y(x.value);
  y.by[0] = x.by[mu_at];
  y.by[1] = x.by[k_at];
  y.by[2] = x.by[R_at];
  return y;
}

LawNumber coefficient_by_law(const RollBite &bite, const CircularBite &s, const double radius)
{
  auto law         = friction_in<LawNumber>(bite.strip.friction);
  const auto place = places_of_constants(law);
  for (std::size_t i = 0; i < n_friction_constants; ++i)
    place[i]->by[std::size_t(first_constant) + i] = 1;
  const LawNumber flux = bite.roll_speed * number_of_bite(s.neutral_cosine * s.neutral_thickness);
  Inlet<LawNumber> in;
  in.roll_speed     = bite.roll_speed;
  in.entry_speed    = flux / bite.strip.entry_thickness;
  in.exit_speed     = flux / bite.strip.exit_thickness;
  in.radius         = LawNumber::variable(radius, 2);
  in.arc_length     = number_of_bite(s.arc_length);
  in.entry_pressure = number_of_bite(s.entry_flow_stress) - bite.strip.entry_tension;
  return coefficient_at(law, in).mu;
}

int place_of(const double Friction::*constant)
{
  for (std::size_t i = 0; i < n_friction_constants; ++i)
    if (friction_constants()[i].member == constant)
      return int(i);
  return -1;
}

/// Force, slip, torque on a circle, by one direction.
Eigen::Vector3d measured_by(const RollBite &bite, const Slope &force, const Slope &slip, const Slope &torque,
                            const int direction)
{
  return {bite.strip.width * force.by[std::size_t(direction)], slip.by[std::size_t(direction)],
          bite.strip.width * torque.by[std::size_t(direction)]};
}

Eigen::Vector3d measured_value(const RollBite &bite, const CircularBite &s)
{
  return {bite.strip.width * s.force.value,
          s.neutral_thickness.value * s.neutral_cosine.value / bite.strip.exit_thickness - 1,
          bite.strip.width * s.torque.value};
}

// A law of factors has no coefficient to differentiate by: a central difference on the arc as it is.
Eigen::Vector3d by_factors(const RollBite &bite, const double radius, const CircularBite &s)
{
  constexpr double step = 1e-4;  // third derivatives of order one: an error of 1e-9, next to rounding of 1e-7
  KarmanOptions quick;
  quick.derivatives   = false;
  quick.points        = 0;
  const auto value_at = [&](const double factor) {
    RollBite other       = bite;
    other.strip.friction = scaled(bite.strip.friction, factor);
    return measured_value(other, solve_on_circle(other, Theory::karman, radius, 0, quick, s.neutral_share));
  };
  return (value_at(1 + step) - value_at(1 - step)) / (2 * step);
}
}  // namespace

FitUnknown fit_unknown(const std::string &name)
{
  for (const auto &[role, word] :
       {std::pair(Role::friction, "friction"), std::pair(Role::flow_stress, "flow_stress")})
    if (name == word)
      return {role, name, nullptr};
  for (const FrictionConstant &constant : friction_constants())
    if (name == constant.key)
      return {Role::constant, name, constant.member};
  throw InputError("bite.fit_for must be friction, flow_stress or a constant of the friction law, not '" + name +
                   "'");
}

Strip with_factors(Strip strip, const std::vector<FitUnknown> &unknowns, const Eigen::VectorXd &log_factors)
{
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double factor = std::exp(log_factors[Eigen::Index(i)]);
    switch (unknowns[i].role) {
    case Role::friction:
      strip.friction = scaled(strip.friction, factor);
      break;
    case Role::flow_stress:
      strip.flow_stress = scaled(strip.flow_stress, factor);
      break;
    case Role::constant:
      strip.friction.*unknowns[i].constant *= factor;
      break;
    }
  }
  return strip;
}

double largest_log_factor(const Strip &strip, const FitUnknown &unknown)
{
  constexpr double largest = 20;  // beyond it the case says something else than the measurement
  double factor            = largest;
  if (unknown.role == Role::friction)
    for (const auto constant : row_of(strip.friction.law).number)
      if (strip.friction.*constant > 0)
        factor = std::min(factor, 1 / (strip.friction.*constant));
  return std::log(factor);
}

PredictedPass predict_pass(const RollBite &bite, const Arc arc, const std::vector<FitUnknown> &unknowns,
                           const Eigen::VectorXd &log_factors, const bool derivatives)
{
  RollBite scaled_bite = bite;
  scaled_bite.strip    = with_factors(bite.strip, unknowns, log_factors);
  KarmanOptions options;
  options.points        = 0;
  options.derivatives   = false;
  const BiteState state = solve_karman(scaled_bite, Theory::karman, arc, nullptr, options);
  PredictedPass out;
  out.value    = {state.force, state.forward_slip, state.torque};
  out.friction = state.friction;
  // The speeds are nan without a speed of the rolls, the slip that comes from them is not.
  if (!(state.force > 0) || !out.value.allFinite())
    throw InputError("the tensions leave no rolling force");
  if (!derivatives)
    return out;

  options.derivatives  = true;
  const double radius  = state.flattened_radius;
  const bool slides_on = slides(scaled_bite.strip.friction);
  const double mu      = slides_on ? state.friction : 0;
  const CircularBite s = solve_on_circle(scaled_bite, Theory::karman, radius, mu, options);
  const Slope slip     = s.neutral_thickness * s.neutral_cosine / scaled_bite.strip.exit_thickness;
  const auto by        = [&](const int direction) {
    return measured_by(scaled_bite, s.force, slip, s.torque, direction);
  };
  const Eigen::Vector3d by_mu = by(mu_at), by_k = by(k_at), by_R = by(R_at);
  const double follows = arc == Arc::hitchcock
                             ? scaled_bite.roll_radius * flattening_compliance(scaled_bite) /
                                   (scaled_bite.strip.entry_thickness - scaled_bite.strip.exit_thickness)
                             : 0;  // m/N, dR' by the force
  const LawNumber law  = slides_on ? coefficient_by_law(scaled_bite, s, radius) : LawNumber(0.0);

  // Coefficient and radius follow what is changed, and each other: (31.4)
  Eigen::Matrix2d closed;
  closed << 1 - law.by[0], -law.by[2], -follows * by_mu[0], 1 - follows * by_R[0];
  const Eigen::Matrix2d inverse = closed.inverse();
  out.by.resize(3, Eigen::Index(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    Eigen::Vector3d held = Eigen::Vector3d::Zero();  // with coefficient and radius held
    double law_moves     = 0;
    if (unknowns[j].role == Role::flow_stress) {
      held      = by_k;
      law_moves = law.by[1];
    } else if (unknowns[j].role == Role::constant) {
      const auto constant = unknowns[j].constant;
      law_moves = law.by[std::size_t(first_constant + place_of(constant))] * scaled_bite.strip.friction.*constant;
    } else if (slides_on) {
      law_moves = mu;
    } else {
      held = by_factors(scaled_bite, radius, s);
    }
    const Eigen::Vector2d moved = inverse * Eigen::Vector2d(law_moves, follows * held[0]);
    out.by.col(Eigen::Index(j)) = held + by_mu * moved[0] + by_R * moved[1];
  }
  return out;
}
}  // namespace mill::bite
