#pragma once
#include "core/records/records.h"
#include "dynamics/response/state_space.h"
#include <Eigen/Core>
#include <string>

namespace mill::dynamics {
/// Two ways to the same numbers.  theory.md 7
enum class HoldForm {
  modal,               ///< one complex number per mode and step: fast; needs eigenvectors that are independent
  matrix_exponential,  ///< one augmented matrix exponential per step length: works for any system
};

/// Outputs of a system on a uniform grid of n times.
struct HoldResult {
  Eigen::VectorXd time;         ///< (n) s, from the first sample of the force on
  Eigen::VectorXd force;        ///< (n) N, the force on the straight lines at these times
  Eigen::MatrixXd output;       ///< (m, n) one column per time
  HoldForm form;                ///< the form that was used
  std::string note;             ///< why it is not the wanted one; empty when it is
  Eigen::Index n_prepared = 0;  ///< lengths of step that were prepared
};

/// Response of a linear system to a force that runs in straight lines between its samples (first-order hold),
/// exact but for rounding: no step limits stability or accuracy, the output rate only decides which peaks are
/// seen. Starts at rest in the equilibrium under the first sample.  Every break point of the force is honoured:
/// where one falls between two output times the step is split there.
///
/// @param system       s states, m outputs
/// @param force        n >= 2 samples, time increasing in s, any spacing
/// @param output_rate  Hz, > 0; the grid is force.time[0] + k / output_rate up to the last sample
/// @param wanted       modal falls back to matrix_exponential when the eigenvectors are so nearly dependent that
///                     the modal form would lose more than 1e-9 (repeated poles of a critically damped mode)
/// @throws SolverError  no equilibrium under the first sample: A is singular
/// Cost: with samples and outputs on a common grid one step length serves for all;
/// modal O(s m) per output.  Otherwise s/2 complex exponentials (modal) or a matrix exponential of size s + 2 per
/// length of step: few lengths if some samples are missing, one for each step if the sampling is irregular.
/// theory.md (7.2) to (7.6)
HoldResult first_order_hold(const StateSpace &system, const ForceRecord &force, double output_rate,
                            HoldForm wanted = HoldForm::modal);
}  // namespace mill::dynamics
