#pragma once
#include "dynamics/bearing/dynamics.h"
#include <memory>

// Equation of motion of a mass on a bearing, and its integration.  theory.md 16
namespace mill::dynamics {
/// What the equation needs at every instant, made from the oscillator once.
struct BearingMotion {
  double mass    = 0;  ///< kg
  double damping = 0;  ///< N s/m
  BearingLaw law;
  Eigen::Vector2d mean_load;  ///< N
  Eigen::Vector2d direction;  ///< -, of length one
  double amplitude = 0;       ///< N
  double frequency = 0;       ///< Hz
  ForceRecord record;         ///< no samples: none
  double begin     = 0;       ///< s, first instant
  double tolerance = 0;       ///< -
};
BearingMotion bearing_motion(const BearingOscillator &oscillator);

Eigen::Vector2d applied_force(const BearingMotion &motion, double time);                            ///< N
Eigen::Vector2d acceleration(const BearingMotion &motion, double time, const BearingState &state);  ///< m/s2
BearingState at_rest(const BearingMotion &motion);  ///< equilibrium under the force of the first instant
bool touches(const BearingMotion &motion, const BearingState &state);

/// The integrator with its state; the only place that knows SUNDIALS.
class MotionIntegrator {
public:
  /// @param motion  kept by reference
  MotionIntegrator(const BearingMotion &motion, const BearingState &start);
  ~MotionIntegrator();
  /// State at a later time, s; adds the losses and returns of the contact on the way.
  /// @throws SolverError
  BearingState advance(double time, std::vector<ContactEvent> &events);
  long steps() const;

private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};
}  // namespace mill::dynamics
