#pragma once
#include <complex>

namespace mill::reduce {
/// A spring with a damper in parallel.
struct SpringAndDamper {
  double stiffness = 0;  ///< N/m
  double damper    = 0;  ///< N s/m
};

/// N/m, dynamic stiffness of a film k + i w b in series with springs: 1/(1/rest + 1/(k + i w b)).  At w = 0 the
/// static series, without bound of w the springs alone: the film locks.  theory.md (29.17)
/// @param rest       N/m, all that is in series with the film
/// @param frequency  Hz
std::complex<double> film_in_series(double rest, const SpringAndDamper &film, double frequency);

/// The spring with a damper in parallel that is the same at one frequency.  theory.md (29.18)
SpringAndDamper equivalent_in_series(double rest, const SpringAndDamper &film, double frequency);
}  // namespace mill::reduce
