#pragma once
#include <Eigen/Core>

/// Accelerations of M y'' + C y' + K y = b F under straight lines between force samples, from equilibrium at F(0):
/// an independent computation in long double and in the physical coordinates [y; y'], with its own matrix
/// exponential (Taylor series with scaling and squaring).
/// @param force  (n) N, spacing h (s)
/// Returns (n, masses) m/s2.
Eigen::MatrixXd exact_hold(const Eigen::VectorXd &M, const Eigen::MatrixXd &K, const Eigen::MatrixXd &C,
                           const Eigen::VectorXd &b, const Eigen::VectorXd &force, double h);
