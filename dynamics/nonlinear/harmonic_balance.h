#pragma once
#include "dynamics/nonlinear/curve_stand.h"
#include <Eigen/Core>
#include <vector>

// Periodic motions of a stand whose contacts follow their curves: free ones, whose frequency goes with their
// amplitude, and those under a harmonic bite force.  theory.md 36.5
namespace mill::dynamics {
/// A periodic motion by the Fourier series of the further compression of every spring.
struct PeriodicMotion {
  bool settled     = false;  ///< false: Newton's method did not settle
  double frequency = 0;      ///< Hz
  Eigen::MatrixXd cosine;    ///< (s, h + 1) m, of spring and harmonic; column 0 is the mean
  Eigen::MatrixXd sine;      ///< (s, h + 1) m, column 0 is zero
  Eigen::MatrixXcd modal;    ///< (n, h + 1) modal displacement, real part of modal e^(i k w t)
  Eigen::VectorXd least;     ///< (s) m, smallest compression of every spring in a period, its rest included
};

/// Free motion of an undamped stand in one of its modes: the modal displacement of that mode is amplitude cos(w t)
/// and its other harmonics; w is solved for.  (36.9)
/// @param mode       place among the modes
/// @param amplitude  kg^1/2 m, modal displacement of the first harmonic, > 0
/// @param harmonics  at least 1
/// @param near       where Newton's method starts; null: the mode of the tangents
/// Cost: some five solutions of s (h + 1) + 1 equations.
PeriodicMotion free_motion(const CurveStand &stand, Eigen::Index mode, double amplitude, int harmonics,
                           const PeriodicMotion *near = nullptr);

/// Steady motion under the bite force `force` cos(2 pi frequency t) about its mean.  (36.10)
/// Cost: some five solutions of s (2 h + 1) equations.
PeriodicMotion forced_motion(const CurveStand &stand, double frequency, double force, int harmonics,
                             const PeriodicMotion *near = nullptr);
}  // namespace mill::dynamics
