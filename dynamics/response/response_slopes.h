#pragma once
#include "dynamics/response/mill_model.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// How the response of a stand to the bite force follows its springs, masses and damping ratios.  theory.md 43
namespace mill::dynamics {
/// A stand in all its n modes, with what each of p parameters changes.  Every mode has its own ratio of critical,
/// which stays when a spring or a mass changes: the damping matrix is a function of M and K.  (43.1)
struct SlopedStand {
  Eigen::VectorXd frequency;               ///< (n) rad/s, undamped
  Eigen::MatrixXd shape;                   ///< (unknowns, n) kg^-1/2, mass-normalised
  Eigen::VectorXd damping;                 ///< (n) -, ratio of critical
  Eigen::VectorXd force;                   ///< (n) kg^-1/2, bite force on each mode
  std::vector<std::string> names;          ///< (p) "K1" .. then "M1" ..
  std::vector<Eigen::MatrixXd> stiffness;  ///< (p) (n, n) 1/s2, dK/dln x in the modes; empty for a mass
  std::vector<Eigen::MatrixXd> mass;       ///< (p) (n, n) -, dM/dln x in the modes; empty for a spring
};

/// All springs that are not zero, by their names, then all masses "M1" .. "Mn".
/// @param damping  (n) -, ratios of critical; the damping matrix and the gap damper of the model are not read
/// @throws SolverError  as modes()
SlopedStand sloped_stand(const MillModel &model, const Eigen::VectorXd &damping);

/// Z_ab = 2 (zeta_a w_a - zeta_b w_b) / (w_a^2 - w_b^2), s: divided difference of the damping of two modes.  Two
/// modes of one frequency take the mean of their ratios: no function of M^-1 K could distinguish them.  (43.4)
double damping_quotient(double wa, double za, double wb, double zb);

/// Accelerations of places per newton of bite force at one frequency, with exact derivatives.
struct ResponseSlopes {
  Eigen::VectorXcd value;       ///< (m) 1/kg
  Eigen::MatrixXcd parameters;  ///< (m, p) 1/kg, to ln of each named parameter
  Eigen::MatrixXcd dampings;  ///< (m, n) 1/kg, to ln of the damping ratio of each mode; their sum: of all at once
};

/// @param seen     (m, n) kg^-1/2, displacement of each place in each mode: rows of SlopedStand::shape
/// @param angular  rad/s, > 0
/// (43.2) to (43.6).  Cost: p n^2 + m p n.
ResponseSlopes response_slopes(const SlopedStand &stand, const Eigen::MatrixXd &seen, double angular);
}  // namespace mill::dynamics
