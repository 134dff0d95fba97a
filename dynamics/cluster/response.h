#pragma once
#include "dynamics/cluster/stack.h"
#include <complex>

// Steady vibration under a harmonic force, linear about the state at rest.  theory.md 38.5
namespace mill::cluster {
/// Complex amplitudes of all unknowns, m: (K + i (eta_c K_c + eta_s K_s) - omega^2 M) u = F with the loss factors
/// of the contacts and supports of the stack.  theory.md (38.16)
/// @param u          state at rest
/// @param force      N, amplitude of every unknown
/// @param frequency  Hz
Eigen::VectorXcd harmonic_response(const Stack &stack, const Motion &u, const Eigen::VectorXd &force,
                                   double frequency);

/// The same over frequencies, one column each.  Cost: one factorisation a frequency.
Eigen::MatrixXcd harmonic_responses(const Stack &stack, const Motion &u, const Eigen::VectorXd &force,
                                    const Eigen::VectorXd &frequencies);

/// Amplitude with loss factor 0 over that with `loss_factor`, one mode: theory.md (38.17)
double detuned_ratio(double mode_frequency, double frequency, double loss_factor);
}  // namespace mill::cluster
