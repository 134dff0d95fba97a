#pragma once
#include "core/records/chatter_record.h"
#include "dynamics/chatter/chatter.h"
#include "dynamics/chatter/speed.h"
#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

// What vibrates, in which phase, and where the roots go when the speed changes.  theory.md 25.5, 25.6
namespace mill::dynamics {
/// Right eigenvector of a root by inverse iteration on the balanced matrix; largest component 1 there.  (s)
Eigen::VectorXcd eigenvector(const Eigen::MatrixXd &A, std::complex<double> root);

/// A mode of stand, bite and strip, scaled so that the gap moves by 1 m in phase 0.  A mode that leaves the gap
/// alone is scaled to 1 m of its largest point instead, and gap is that small number.
struct ChatterMode {
  std::complex<double> root;               ///< 1/s
  double frequency = 0;                    ///< Hz
  double damping   = 0;                    ///< -, -Re/|root|
  Eigen::VectorXcd state;                  ///< (s) in the order of chatter_matrix
  std::vector<ChatterPoint> body;          ///< (m)
  double work_roll_ratio = not_given;      ///< -, amplitude of the upper work roll over that of the lower
  std::complex<double> gap;                ///< m
  std::complex<double> force;              ///< N
  std::complex<double> entry_tension;      ///< Pa
  std::complex<double> exit_tension;       ///< Pa
  std::complex<double> friction;           ///< -
  double force_phase         = not_given;  ///< deg, -180..180, against the gap
  double entry_tension_phase = not_given;  ///< deg
  double exit_tension_phase  = not_given;  ///< deg
  double friction_phase      = not_given;  ///< deg; nan: the friction stands still
  double force_to_friction   = not_given;  ///< deg, phase of the force against the friction
};

/// @param root  an eigenvalue of chatter_matrix(stand, by), 1/s
ChatterMode chatter_mode(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                         std::complex<double> root);

/// Modes of a structure alone.
struct FreeModes {
  Eigen::VectorXd undamped;   ///< (n) Hz, without dampers, ascending
  Eigen::VectorXd frequency;  ///< (k) Hz, |root|/2 pi with dampers, ascending; the k vibrating ones
  Eigen::VectorXd damping;    ///< (k) -, ratio of critical
  int overdamped = 0;         ///< pairs of roots that do not vibrate
  Eigen::MatrixXd shape;      ///< (m, n) displacement of the points in the undamped modes, largest +-1
};
FreeModes free_modes(const StandStructure &structure);

/// Roots over speed, sorted into branches.
struct RootLocus {
  Eigen::VectorXd speed;    ///< (k) m/s
  Eigen::MatrixXcd branch;  ///< (s, k) 1/s, one row per root, both of a pair; nan: no bite
};

/// Follows every root from speed to speed: each goes to where its path points (least sum of distances).  Where
/// that is not clear, speeds between are tried, which do not appear in the result.
/// @param speeds  (k) m/s, ascending
RootLocus root_locus(const MatrixAtSpeed &matrix, const Eigen::VectorXd &speeds);
}  // namespace mill::dynamics
