#pragma once
#include "dynamics/modes.h"

namespace mill::dynamics {
/// Fixed-step methods that co-simulation masters and multibody programs use.
enum class StepMethod {
  implicit_euler,     ///< damps every mode by about w h / 2 of critical
  newmark,            ///< average acceleration, beta = 1/4, gamma = 1/2: no damping, frequencies too low
  generalised_alpha,  ///< Chung and Hulbert, spectral radius rho at infinite frequency
};

/// How an undamped mode looks after a fixed-step method: the frequency it appears at, the damping ratio it
/// acquires.
///
/// @param frequency  Hz, > 0, of the undamped mode
/// @param step       s, > 0
/// @param rho        -, 0..1, generalised_alpha only
/// Used to judge the step of a co-simulation: this program itself integrates exactly (7.2).  theory.md (7.9),
/// (7.10) Source: J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371-375, doi 10.1115/1.2900803.
Pole seen_through(StepMethod method, double frequency, double step, double rho = 1);
}  // namespace mill::dynamics
