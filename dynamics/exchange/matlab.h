#pragma once
#include "dynamics/exchange/exchanged_stand.h"
#include <string>

namespace mill::dynamics {
/// The function NAME.m for MATLAB and Octave: reads NAME.mat in the same folder, builds the first-order form, and
/// drives it with a force in equal steps, linear between them.  No toolbox.  theory.md 35.7
std::string matlab_function(const ExchangedStand &stand);

/// The file NAME.mat: M, C, K, b, point, load_cell, load_cell_share, F_mean, frequency, names and units.
std::string matlab_data(const ExchangedStand &stand);
}  // namespace mill::dynamics
