#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/numerics/derivative.h"
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

// The strip's material along a streamline: isotropic elasticity, von Mises yield, isotropic hardening, plane
// strain. Stress is carried along with the material (Jaumann's rate).  theory.md 19.2
namespace mill::fem {
/// Yield and elasticity in the units of the pass.
struct StripMaterial {
  const FlowStress *law = nullptr;  ///< plane strain, of the thickness strain ln(h0/h)
  double unit           = 1;        ///< Pa, of one unit of stress
  double compliance     = 0;        ///< -, 1/(2 G); 0: rigid-plastic
  double cutoff_strain_rate =
      0;  ///< -, rate of shear below which the strip flows like a viscous liquid; 0: a sharp yield limit
};

/// Flow stress at a strain, scaled.
template <class T> T material_flow_stress(const StripMaterial &m, const T &strain)
{
  return bite::carried_flow_stress(*m.law, strain) / m.unit;
}

/// What drives one row of an element: at its two Radau points (a third of the way and the end) the velocity
/// gradient times the time the element takes there, then the state at its upstream end and the factor on the flow
/// stress.
enum RowInput {
  gradient_xx,
  gradient_xy,
  gradient_yx,
  gradient_yy,
  transit,
  n_at_point,
  upstream_xx = 2 * n_at_point,
  upstream_yy,
  upstream_xy,
  upstream_strain,
  stress_factor,
  n_row_inputs
};
/// What comes out at each of the two points: deviatoric stress and plastic shear over the element at the rate
/// there.
enum RowState { stress_xx, stress_yy, stress_xy, plastic_shear, n_row_state };

// Radau IIA, two stages, as a derivative: c (d s_i + e s_other + f s_0) = strain; strain_i = e0 + sum of a
// gamma/2.  The strain at the first point is gathered from the rate there alone: Radau's own weight of the other
// one is negative, and a strain that falls where yielding begins would let the strip soften.
struct RadauStage {
  double same, other, upstream;         ///< -, of the derivative
  double gathered_own, gathered_other;  ///< -, of the integral
};
constexpr std::array<RadauStage, 2> radau{{{1.5, 0.5, -2, 1. / 3, 0}, {2.5, -4.5, 2, 1. / 4, 3. / 4}}};
constexpr std::array<double, 2> radau_point{1. / 3, 1}, radau_weight{3. / 4, 1. / 4};

/// One point alone: stress s with  s (c + S/(2 tau)) = e,  S = sqrt(gamma^2 + (g0 t)^2),  gamma = 2 S/(2 tau) |s|,
/// (19.6).
/// @param c   -, compliance of the stage; 0: rigid
/// @param e   deviatoric part of the strain over the element and what the stress brings along, xx yy xy
/// @param strain_before, share  thickness strain is strain_before + share gamma/2
/// @param guess  of gamma
/// @return gamma; differentiated by the equation it solves and not through its iterations
template <class T>
T return_mapping(const StripMaterial &m, const double c, const std::array<T, 3> &e, const T &time,
                 const T &strain_before, const double share, const T &factor, const double guess, T *stress,
                 bool &plastic)
{
  using bite::value_of;
  using std::sqrt;
  const T zz     = -1.0 * (e[0] + e[1]);
  const T size   = sqrt(2.0 * (e[0] * e[0] + e[1] * e[1] + zz * zz) + 4.0 * e[2] * e[2] + 1e-300);
  const double q = value_of(size), cutoff = m.cutoff_strain_rate * value_of(time),
               before = value_of(strain_before);
  struct Yield {
    double value, slope;  ///< shear yield stress and its derivative by gamma
  };
  const auto yield = [&](const double gamma) {
    const auto k = material_flow_stress(m, bite::Dual<1>::variable(before + 0.5 * share * gamma, 0));
    return Yield{0.5 * value_of(factor) * k.value, 0.25 * value_of(factor) * share * k.by[0]};
  };
  // Residual 2 c tau gamma/S + gamma - q of the plastic shear, monotone; its slope
  const auto residual = [&](const double g, double &slope) {
    const Yield y   = yield(g);
    const double S  = std::hypot(g, cutoff);
    const double on = cutoff == 0 ? 1 : g / S;
    slope           = 1 + 2 * c * (y.slope * on + (cutoff == 0 ? 0 : y.value * cutoff * cutoff / (S * S * S)));
    return 2 * c * y.value * on + g - q;
  };
  double g = q;
  plastic  = c == 0 || cutoff > 0 || q > 2 * c * yield(0).value;
  if (c > 0 && plastic) {
    // Concave: from the left Newton's method cannot overshoot; a guess to the right is brought there by its first
    // step.
    g = guess > 0 ? guess : std::max(q - 2 * c * yield(0).value, 0.);
    for (int i = 0; i < 100; ++i) {
      double slope;
      const double step = -residual(g, slope) / slope;
      g                 = std::max(g + step, 0.);
      if (std::abs(step) <=
          1e-9 * std::min(q, cutoff > 0 ? std::max(g, 1e-6 * q) : q))  // the next one is its square
        break;
    }
  }
  T gamma(0.), resistance(c);
  if (plastic) {
    const T cutoff_increment = m.cutoff_strain_rate * time;
    const auto shear_yield   = [&](const T &x) {
      return 0.5 * factor * material_flow_stress(m, T(strain_before + 0.5 * share * x));
    };
    const auto norm = [&](const T &x) {
      return cutoff == 0 ? x : T(sqrt(x * x + cutoff_increment * cutoff_increment));
    };
    if (c == 0) {
      gamma = size;
    } else {
      double slope;
      residual(g, slope);
      const T on = cutoff == 0 ? T(1.) : g / norm(T(g));
      gamma      = T(g) - (2.0 * c * shear_yield(T(g)) * on + g - size) / slope;
    }
    resistance = c + norm(gamma) / (2.0 * shear_yield(gamma));
  }
  for (int i = 0; i < 3; ++i)
    stress[i] = e[i] / resistance;
  return gamma;
}

/// Point i of a row once more from the stress at both, (19.5): the solution is where both reproduce themselves.
/// @param state  (2 n_row_state)
/// @param next   (n_row_state) may be part of state
template <class T>
void point_again(const StripMaterial &m, const int i, const T *in, const T *state, T *next,
                 std::array<bool, 2> &plastic)
{
  const RadauStage &r = radau[i];
  const T *a = in + n_at_point * i, *same = state + n_row_state * i, *other = state + n_row_state * (1 - i);
  const T third = (a[gradient_xx] + a[gradient_yy]) / 3.0, spin = a[gradient_yx] - a[gradient_xy];
  const double c  = m.compliance;
  const auto kept = [&](const int s) { return r.other * other[s] + r.upstream * in[upstream_xx + s]; };
  const std::array<T, 3> e{a[gradient_xx] - third - c * (kept(stress_xx) + spin * same[stress_xy]),
                           a[gradient_yy] - third - c * (kept(stress_yy) - spin * same[stress_xy]),
                           0.5 * (a[gradient_xy] + a[gradient_yx]) -
                               c * (kept(stress_xy) - 0.5 * spin * (same[stress_xx] - same[stress_yy]))};
  const T before      = in[upstream_strain] + 0.5 * r.gathered_other * other[plastic_shear];
  const T gamma       = return_mapping(m, r.same * c, e, a[transit], before, r.gathered_own, in[stress_factor],
                                       bite::value_of(same[plastic_shear]), next, plastic[i]);
  next[plastic_shear] = gamma;
}

/// Both points once more.
template <class T>
void stress_update(const StripMaterial &m, const T *in, const T *state, T *next, std::array<bool, 2> &plastic)
{
  for (int i = 0; i < 2; ++i)
    point_again(m, i, in, state, next + n_row_state * i, plastic);
}

/// Solution of a row with its derivatives by the inputs.
struct RowSolution {
  Eigen::Matrix<double, 2 * n_row_state, 1> state;
  Eigen::Matrix<double, 2 * n_row_state, n_row_inputs> by;
  std::array<bool, 2> plastic{};
  bool solved = false;
};
/// Solves a row: alternating points (a contraction, since Radau IIA is algebraically stable), then Newton's
/// method.
/// @param guess        of the state, or null
/// @param derivatives  false leaves `by` alone
inline RowSolution solve_row(const StripMaterial &m, const std::array<double, n_row_inputs> &in,
                             const Eigen::Matrix<double, 2 * n_row_state, 1> *guess, const bool derivatives)
{
  constexpr int n = 2 * n_row_state;
  using Vector    = Eigen::Matrix<double, n, 1>;
  RowSolution out;
  Vector &z = out.state;
  if (guess) {
    z = *guess;
  } else {
    z.setZero();
    for (int i = 0; i < 2; ++i)
      for (int s = 0; s < 3; ++s)
        z[n_row_state * i + s] = in[upstream_xx + s];
  }
  const auto mismatch = [&](const Vector &x) {
    Vector next;
    stress_update(m, in.data(), x.data(), next.data(), out.plastic);
    return Vector(x - next);
  };
  const auto alternate = [&] {
    for (int i = 0; i < 2; ++i)
      point_again(m, i, in.data(), z.data(), z.data() + n_row_state * i, out.plastic);
  };
  constexpr double enough = 1e-14;
  double error            = 1;
  alternate();
  alternate();
  for (int step = 0; step < 60; ++step) {
    const Vector d = mismatch(z);
    error          = d.norm();
    if (!(error > enough))
      break;
    std::array<bite::Dual<n>, n> x, next;
    std::array<bite::Dual<n>, n_row_inputs> fixed;
    for (int i = 0; i < n; ++i)
      x[i] = bite::Dual<n>::variable(z[i], i);
    for (int i = 0; i < n_row_inputs; ++i)
      fixed[i] = bite::Dual<n>(in[i]);
    stress_update(m, fixed.data(), x.data(), next.data(), out.plastic);
    Eigen::Matrix<double, n, n> K = Eigen::Matrix<double, n, n>::Identity();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        K(i, j) -= next[i].by[j];
    const Vector trial = z - K.partialPivLu().solve(d);
    if (mismatch(trial).norm() < 0.5 * error)
      z = trial;
    else if (error < 1e-11)
      break;
    else
      for (int sweep = 0; sweep < 2; ++sweep)
        alternate();
  }
  out.solved = error < 1e-10;
  if (!out.solved && guess)
    return solve_row(m, in, nullptr, derivatives);
  mismatch(z);  // leaves the yielding points of this state in out.plastic
  if (!derivatives)
    return out;
  std::array<bite::Dual<n + n_row_inputs>, n> x, next;
  std::array<bite::Dual<n + n_row_inputs>, n_row_inputs> moving;
  for (int i = 0; i < n; ++i)
    x[i] = bite::Dual<n + n_row_inputs>::variable(z[i], i);
  for (int i = 0; i < n_row_inputs; ++i)
    moving[i] = bite::Dual<n + n_row_inputs>::variable(in[i], n + i);
  stress_update(m, moving.data(), x.data(), next.data(), out.plastic);
  Eigen::Matrix<double, n, n> K = Eigen::Matrix<double, n, n>::Identity();
  Eigen::Matrix<double, n, n_row_inputs> right;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      K(i, j) -= next[i].by[j];
    for (int j = 0; j < n_row_inputs; ++j)
      right(i, j) = next[i].by[n + j];
  }
  out.by = K.partialPivLu().solve(right);
  return out;
}
}  // namespace mill::fem
