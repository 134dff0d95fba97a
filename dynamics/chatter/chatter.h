#pragma once
#include "dynamics/chatter/stand_structure.h"
#include "reduce/bite/linear/linear_coefficients.h"
#include <Eigen/Core>

// The bite, the stand and the strip between the stands as one linear system.  theory.md 25
namespace mill::dynamics {
/// A stand and the strip before and behind it, whose far ends run at constant speed.
struct ChatterStandModel {
  StandStructure structure;
  double entry_distance = 0;      ///< m, to the previous stand; > 0
  double exit_distance  = 0;      ///< m, to the next stand; > 0
  double strip_modulus  = 210e9;  ///< Pa
};

/// The steady bite at one roll speed, ready to be coupled.
struct WorkingPoint {
  bite::RollBite bite;  ///< with its speed
  bite::BiteState state;
  bite::LinearCoefficients by;
};

/// Steady state with Hitchcock's flattening and its derivatives.
/// @param speed  m/s, > 0
/// @throws InputError, SolverError  as solve_bland_ford: no neutral point (the rolls skid), flattening that
/// diverges
///
/// Cost: 40 us.
WorkingPoint working_point(bite::RollBite bite, double speed, Linearisation scheme);

/// (2n+2, 2n+2) A of  z' = A z,  z = (x, x', d sigma_e, d sigma_d) in SI.  The flattened radius keeps its value.
/// theory.md (25.4)
Eigen::MatrixXd chatter_matrix(const ChatterStandModel &stand, const bite::LinearCoefficients &by);

/// (s) scale of each state: z_i = scale_i * z~_i makes the rows and columns of A of like size (Osborne's balancing
/// by powers of two), which a matrix with entries 1, K/M and E/L needs.  A~ = diag(1/scale) A diag(scale).
Eigen::VectorXd balance(const Eigen::MatrixXd &A);

/// Eigenvalues of a real matrix after balancing, by falling real part; of a pair the one with positive imaginary
/// part comes first.  1/s
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A);

/// Largest real part of the eigenvalues, 1/s: positive means that vibration grows.
double growth_rate(const Eigen::MatrixXd &A);
}  // namespace mill::dynamics
