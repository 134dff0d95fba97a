#pragma once
#include "reduce/bite/bite.h"

// Hot rolling formulas in closed form: friction at the shear yield stress all along the arc.
namespace mill::bite {
/// Force and torque by Sims' formula for one flow stress, small angles.  (17.9)
struct SimsForce {
  double force;          ///< N/m, per width
  double torque;         ///< N, per width, of one roll
  double neutral_angle;  ///< rad
  double factor;         ///< -, Q = force / (k sqrt(R dh))
};

/// @param radius  m, of the arc
/// @param arm     m, of the torque: radius of the roll
/// @param yield   Pa, plane-strain flow stress
/// @throws InputError  exit not thinner than entry
/// Source: R. B. Sims, Proc. Inst. Mech. Eng. 168 (1954) 191; the formula derived again from (17.4) with w = pi/4.
SimsForce sims_force(double radius, double arm, double entry_thickness, double exit_thickness, double yield);

/// Force factors of two fits to Sims and its kin, for reports next to the theories, with what is known of them.
struct ForceFactor {
  const char *name;
  double factor;     ///< -, force / (k sqrt(R dh))
  const char *note;  ///< that the formula was quoted from memory and not looked up
};
/// Ford and Alexander, Denton and Crane.  (17.10)
std::vector<ForceFactor> fitted_force_factors(double radius, double entry_thickness, double exit_thickness);

/// State by Sims' formula; the flow stress is its mean over the arc.
/// @throws InputError  mu below 0.25 or factors below 0.5, where the strip does not stick; tensions, which the
/// formula
///                     does not know; exit not thinner than entry
BiteState solve_sims(const RollBite &bite, Arc arc, int points);
}  // namespace mill::bite
