#pragma once
#include "reduce/bite/slab/pass_inputs.h"

namespace mill::bite {
/// Positions of the curves: n on each side of the neutral point, which belongs to both; evenly spaced on each.  (2
/// n - 1) m
Eigen::VectorXd curve_positions(double exit, double neutral, double entry, int n);

/// Fills thickness and slip of a state from its positions and speeds.
void fill_curves(BiteState &state, const PassInputs<double> &in, double entry_speed);

/// Marks the derivatives by roll speed and gap rate as unknown where no roll speed is given.
void forget_unknown_speeds(const RollBite &bite, BiteState &state);
}  // namespace mill::bite
