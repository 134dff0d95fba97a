#pragma once
#include "reduce/bite/fit/fit.h"
#include <functional>

// The fit when force, slip and torque come from a costlier model than the slab.  theory.md 31.5
namespace mill::bite {
/// Force (N), forward slip (-) and torque (N m) of each pass by that model.
/// @param log_factors  (n) logarithms of the factors
/// @throws InputError, SolverError  the model has no answer for such a strip
using PassModel = std::function<std::vector<Eigen::Vector3d>(const Eigen::VectorXd &log_factors)>;

/// Solves the fit for the values of the model.  Each round computes the model at the present point, corrects the
/// slab by its difference to the model, (31.7), and fits again; from the second round on the next point is
/// extrapolated from the rounds before, (31.8).  It ends when a round moves no measured value by 0.01 standard
/// deviations.  Where the slab sticks everywhere and no longer depends on what is fitted, slopes of the model
/// itself take its place.
///
/// @param problem  gets the factors and shifts of the last round
/// @param start    least misfit by the slab
/// @return least misfit by the model
/// @throws InputError, SolverError  what the model throws at the start
/// @throws SolverError  not settled after 20 rounds, or the model has no answer near the fitted point
/// Cost: usually 3 to 6 rounds.
/// Source: D. G. Anderson, J. ACM 12 (1965) 547 (extrapolation).
FitPoint fit_to_model(FitProblem &problem, const FitPoint &start, const PassModel &model);
}  // namespace mill::bite
