#pragma once
#include "dynamics/response/mill_model.h"
#include <Eigen/Core>
#include <array>

namespace mill::dynamics {
/// Steady response per newton of harmonic bite force.
struct FrequencyResponse {
  Eigen::VectorXd frequency;      ///< (m) Hz
  Eigen::MatrixXcd acceleration;  ///< (m, n) 1/kg, acceleration of every mass over force
  Eigen::VectorXcd load_cell;     ///< (m) -, change of the load-cell force over change of the bite force
};

/// Solves (K - w^2 M + i w C) y = b at each frequency.  theory.md (6.16)
/// @param frequency  (m) Hz, >= 0
/// Cost: m complex solves of n equations.  An undamped model has no value at its own frequencies: infinite there.
FrequencyResponse frequency_response(const MillModel &model, const Eigen::VectorXd &frequency);

/// Largest acceleration of each mass that any force inside a range of the given half width can cause, whatever its
/// spectrum: half range times the total variation of the response to a unit step.  (n) m/s2  theory.md (7.8)
///
/// @param half_range  N, half of peak to peak
/// @param duration    s, length of the step response; a bound for forces not longer than this, and for all forces
///                    once the slowest mode has died out
/// @param rate        Hz, sampling of the step response; 20 times the highest frequency is within 0.5 %
/// @throws SolverError  as equilibrium
/// Cost: one product of a matrix of 2n with a vector per sample.
Eigen::VectorXd largest_response(const MillModel &model, double half_range, double duration, double rate);
}  // namespace mill::dynamics
