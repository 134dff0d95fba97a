#pragma once
#include "dynamics/chatter/chatter.h"
#include <complex>

// The coupled stand as a loop of two transfer functions: the structure answers the force, the bite answers the
// gap. theory.md 25
namespace mill::dynamics {
/// G(s) = b^T (M s^2 + C s + K)^-1 b: gap per force of the structure alone, m/N.  (25.5)
std::complex<double> receptance(const StandStructure &structure, std::complex<double> s);

/// K_p(s): force per gap of the bite with the strip before and behind it, N/m; a negative real part holds the gap
/// like a spring.  (25.6)
std::complex<double> process_stiffness(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                                       std::complex<double> s);

/// 1 - K_p(s) G(s), zero at every root of the coupled system that moves the gap.  (25.7)
std::complex<double> loop_difference(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                                     std::complex<double> s);

/// Im K_p(i w)/w, N s/m: what the bite takes from (negative) or adds to (positive) the damping of the gap.
/// @param frequency  Hz, > 0
double process_damping(const ChatterStandModel &stand, const bite::LinearCoefficients &by, double frequency);

/// Count of roots by Nyquist's criterion.
struct NyquistCount {
  int unstable  = 0;  ///< roots of the coupled system right of the line
  int open_loop = 0;  ///< poles of the structure alone there
  int steps     = 0;  ///< points evaluated on the line
};

/// Number of roots with Re s > right_of, from the winding of 1 - K_p G along that line.  (25.8)
/// @param right_of  1/s, >= 0; above zero where the structure has undamped modes, which lie on the axis itself
/// @throws SolverError  a root or a pole on the line
/// Cost: some 500 evaluations, 1 ms for six masses.
NyquistCount nyquist_count(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                           double right_of = 0);
}  // namespace mill::dynamics
