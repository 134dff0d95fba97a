#pragma once
#include "dynamics/exchange/exchanged_stand.h"
#include <string>

namespace mill::dynamics {
/// A package of Modelica 3.4, one file: the model as equations without any library, the masses, springs and
/// dampers of the Modelica Standard Library 4.0.0 where it is a chain, a test in which the force jumps with the
/// expected peak, and the recorded force where there is one.  theory.md 35.7
/// @param series_file  file of modelica_series() for a long record, as the model names it; not used for a short
/// one
std::string modelica_package(const ExchangedStand &stand, const std::string &series_file);

/// Records of at most this many samples are written into the package.
constexpr Eigen::Index longest_series_in_package = 500;

/// The recorded force as a table of CombiTimeTable (text file, version 1): time in s, force in N.
std::string modelica_series(const ForceRecord &force);
}  // namespace mill::dynamics
