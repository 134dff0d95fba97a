#include "tests/manual/solvers/closed_coefficients.h"
#include "core/laws/flow_stress_law.h"
#include "core/numerics/derivative.h"
#include "core/numerics/gauss.h"

namespace mill::bite {
LinearCoefficients closed_coefficients(const RollBite &bite, const BiteState &state)
{
  const Strip &s    = bite.strip;
  const Friction &f = s.friction;
  const double R = state.flattened_radius, h_e = s.entry_thickness, h_d = s.exit_thickness, v_r = bite.roll_speed;
  const double x_e = state.arc_length, x_n = state.neutral_position, v_e = state.entry_speed,
               v_d = state.exit_speed;
  const double mu = state.friction, h_f = state.film_thickness, sigma_e = s.entry_tension,
               sigma_d = s.exit_tension;
  const double h0      = s.initial_thickness;
  const auto yield     = [&](const double h) {  // k_f and dk_f/dh
    const Dual<1> strain = std::log(h0) - log(Dual<1>::variable(h, 0));
    return flow_stress(s.flow_stress, strain);
  };
  const double k_e = yield(h_e).value, dk_e = yield(h_e).by[0], k_d = yield(h_d).value, dk_d = yield(h_d).by[0];

  // film and friction, (8.29)
  const double xe_hd = -R / (2 * x_e), xe_he = -xe_hd, xd_rate = R * h_d / (2 * v_e * h_e);
  const double E = std::exp(-f.pressure_viscosity * (k_e - sigma_e)), mu_film = -f.decay * (mu - f.mu0);
  const double film_sigma = h_f * f.pressure_viscosity * E / (1 - E);
  const StripRow m{mu_film * (-h_f / x_e) * xe_hd, 0, mu_film * film_sigma, 0,
                   mu_film * (-h_f / x_e * xe_he - film_sigma * dk_e)};

  // neutral point, (8.30)
  const double T = x_n / std::sqrt(R * h_d), S = 1 + T * T;
  const double balance = std::log((k_d - sigma_d) * h_e * k_e / ((k_e - sigma_e) * h_d * k_d));
  const double xn_xe = 0.5 * S * h_d / h_e, xn_xd = 0.5 * S, xn_mu = S * h_d * balance / (4 * mu * mu);
  const double xn_kd = -S * h_d * sigma_d / (4 * mu * k_d * (k_d - sigma_d));
  const double xn_ke = S * h_d * sigma_e / (4 * mu * k_e * (k_e - sigma_e));
  const StripRow n{S * (-balance / (8 * mu) + 1 / (4 * mu) - x_e / (4 * h_e)) + 0.5 * std::sqrt(R / h_d) * T +
                       xn_xe * xe_hd + xn_kd * dk_d + xn_mu * m[0],
                   xn_xd * xd_rate, -S * h_d / (4 * mu * (k_e - sigma_e)) + xn_mu * m[2],
                   S * h_d / (4 * mu * (k_d - sigma_d)),
                   -S * h_d / (4 * mu * h_e) + xn_xe * xe_he + xn_ke * dk_e + xn_mu * m[4]};

  // speeds, (8.31)
  const double w = 2 * v_r * x_n / (R * h_e);
  const StripRow P{v_r / h_e + w * n[0], (x_e - x_n) / h_e + w * n[1], w * n[2], w * n[3], -v_e / h_e + w * n[4]};
  StripRow Q;
  for (int i = 0; i < 5; ++i)
    Q[i] = h_e / h_d * P[i];
  Q[0] -= v_d / h_d;
  Q[1] -= x_e / h_d;
  Q[4] += v_e / h_d;

  // force, (8.32) on the entry side and (8.33) on the exit side
  const double root = std::sqrt(R * h_d);
  const auto H      = [&](const double x) { return 2 * std::sqrt(R / h_d) * std::atan(x / root); };
  const double H_e = H(x_e), He_hd = -H_e / (2 * h_d) - x_e / (h_d * h_e) + 2 / h_e * xe_hd,
               He_he = 2 / h_e * xe_he;
  StripRow F{(k_e - sigma_e) * xe_hd, -(k_d - sigma_d) * xd_rate, 0, 0, (k_e - sigma_e) * xe_he};
  const GaussRule rule = gauss_legendre(48);
  for (const bool entry_side : {true, false}) {
    const double a = std::atan((entry_side ? x_n : 0) / root), b = std::atan((entry_side ? x_e : x_n) / root);
    for (int i = 0; i < 48; ++i) {
      const double t = 0.5 * (a + b) + 0.5 * (b - a) * rule.node[i], x = root * std::tan(t);
      const double dx = 0.5 * (b - a) * rule.weight[i] * root * (1 + std::tan(t) * std::tan(t));
      const double h = h_d + x * x / R, k = yield(h).value, delta = 1 / h + yield(h).by[0] / k;
      const double H_x = H(x), H_hd = -H_x / (2 * h_d) - x / (h_d * h);
      if (entry_side) {
        const double p = (k_e - sigma_e) * h * k / (h_e * k_e) * std::exp(mu * (H_e - H_x)) * dx;
        F[0] += p * (delta + m[0] * (H_e - H_x) + mu * (He_hd - H_hd));
        F[2] += p * (-1 / (k_e - sigma_e) + m[2] * (H_e - H_x));
        F[4] += p * (-1 / h_e + dk_e * sigma_e / (k_e * (k_e - sigma_e)) + m[4] * (H_e - H_x) + mu * He_he);
      } else {
        const double p = (k_d - sigma_d) * h * k / (h_d * k_d) * std::exp(mu * H_x) * dx;
        F[0] += p * (delta - 1 / h_d + dk_d * sigma_d / (k_d * (k_d - sigma_d)) + m[0] * H_x + mu * H_hd);
        F[1] -= p * mu * 2 / h_d * xd_rate;
        F[2] += p * m[2] * H_x;
        F[3] -= p / (k_d - sigma_d);
        F[4] += p * m[4] * H_x;
      }
    }
  }
  for (double &value : F)
    value *= s.width;
  return {P, Q, F, m, n};
}
}  // namespace mill::bite
