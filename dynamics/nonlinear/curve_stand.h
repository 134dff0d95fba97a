#pragma once
#include "spring_law.h"
#include <cstddef>
#include <string>
#include <vector>

// A stand in n of its modes whose contacts and bearings follow their curves.  Standard library alone, as
// spring_law.h.  theory.md 36.1
namespace mill::dynamics {
/// One spring of the stand that follows a curve: a contact, a bearing with what is in series with it, or one place
/// of a contact line.
struct CurveSpring {
  std::string name;         ///< "K3"; the places of one contact line have one name
  std::size_t law = 0;      ///< in CurveStand::laws: force of the whole spring over its compression
  double share    = 1;      ///< -, part of the force of the law that acts here
  std::vector<double> row;  ///< (n) kg^-1/2, compression per modal displacement
  double rest      = 0;     ///< m, compression at rest
  double force     = 0;     ///< N, of the law at rest
  double stiffness = 0;     ///< N/m, slope of the law at rest: what the modes are made with
};

/// q_k'' + 2 zeta w_k q_k' + w_k^2 q_k = push_k (F - c push . q') - sum_j row_jk share_j rho_j(row_j . q),
/// rho_j(d) = law_j(rest_j + d) - force_j - stiffness_j d: what the curve adds to its tangent.  (36.4)
struct CurveStand {
  std::vector<double> rate;  ///< (n) rad/s, w_k, undamped, of the springs' tangents at rest
  std::vector<double> push;  ///< (n) kg^-1/2, bite force on each mode
  double damping    = 0;     ///< -, zeta, ratio of critical of every mode
  double gap_damper = 0;     ///< N s/m, c
  std::vector<SpringLaw> laws;
  std::vector<CurveSpring> springs;
  std::size_t modes() const
  {
    return rate.size();
  }
};

/// What spring j adds to its tangent at a further compression d: force (N), its slope (N/m) and its energy (J)
/// from rest, all of the share.  (36.3)
SpringForce beyond_tangent(const CurveStand &stand, const CurveSpring &spring, double d);
double energy_beyond_tangent(const CurveStand &stand, const CurveSpring &spring, double d);

/// m, further compression of a spring: row . q, q (n).
double further_compression(const CurveSpring &spring, const double *q);

/// J, kinetic and strain energy of the motion about rest, without the work of what holds the stand at rest. (36.5)
/// @param q, rate_of_q  (n)
double energy_of(const CurveStand &stand, const double *q, const double *rate_of_q);
}  // namespace mill::dynamics
