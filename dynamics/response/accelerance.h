#pragma once
#include "core/records/stand_model.h"
#include <Eigen/Core>
#include <complex>
#include <vector>

// Acceleration over harmonic force between places of a stand.  theory.md 32
namespace mill::dynamics {
/// A stand in n of its modes, seen at m places and pushed at k.
struct ModalResponse {
  Eigen::VectorXd frequency;  ///< (n) Hz, undamped
  Eigen::MatrixXd seen;       ///< (m, n) kg^-1/2, displacement of each place in each mass-normalised mode
  Eigen::MatrixXd pushed;     ///< (k, n) kg^-1/2, the same of the forces
  Eigen::VectorXd gap;        ///< (n) kg^-1/2, of the bite force, which the damper of the gap acts along
  double damping    = 0;      ///< -, ratio of critical of every mode
  double gap_damper = 0;      ///< N s/m
  Eigen::MatrixXd
      dampers;  ///< (r, n) sqrt(N s/(m kg)), roots of the dampers of connections in the modes; may be empty
};

/// @param frequency  (n) Hz
/// @param shape      (unknowns, n) kg^-1/2, mass-normalised
/// @param seen       rows of places of the stand
/// @param pushed     rows of forces on the stand
ModalResponse modal_response(const StandModel &stand, const Eigen::VectorXd &frequency,
                             const Eigen::MatrixXd &shape, const std::vector<Eigen::VectorXd> &seen,
                             const std::vector<Eigen::VectorXd> &pushed, double damping, double gap_damper);

/// The first n modes of it.
ModalResponse first_modes(const ModalResponse &all, Eigen::Index n);

/// (m, k) 1/kg: sum over the modes, the damper of the gap and those of connections by one rank each.
/// (32.3), (32.4)
/// @param frequency  Hz, >= 0.  An undamped stand has no value at its own frequencies: infinite there.
/// Cost: m k n.
Eigen::MatrixXcd accelerance(const ModalResponse &stand, double frequency);

/// (n, n) N s/m: damping of the ratio `damping` in every mode, 2 damping M (M^-1 K)^(1/2), by a matrix square root
/// and without any mode.  (32.5)
/// @param M  (n, n) kg, positive definite
/// @param K  (n, n) N/m, positive definite
/// @throws SolverError  the iteration of the root does not settle
/// Cost: some twenty inversions of n x n.
Eigen::MatrixXd modal_damping_matrix(const Eigen::MatrixXd &M, const Eigen::MatrixXd &K, double damping);

/// Matrices of a damped stand, for a solution without modes.
struct DampedStand {
  Eigen::MatrixXd M, K, C;  ///< (n, n) kg, N/m, N s/m
};
/// With the damping of (32.5) and a damper (N s/m) along the bite force.  Errors as modal_damping_matrix.
DampedStand damped_stand(const StandModel &stand, double damping, double gap_damper);

/// 1/kg: -w^2 seen (K + i w C - w^2 M)^-1 pushed, by one factorisation.  (32.1)
std::complex<double> direct_accelerance(const DampedStand &stand, const Eigen::VectorXd &seen,
                                        const Eigen::VectorXd &pushed, double frequency);

/// Hz, ascending: where the response of these modes is looked at between two frequencies, close together within
/// the resonances and wider between them.
/// @param modes  (n) Hz
Eigen::VectorXd frequencies_around(const Eigen::VectorXd &modes, double damping, double low, double high);
}  // namespace mill::dynamics
