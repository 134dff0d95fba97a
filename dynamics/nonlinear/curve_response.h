#pragma once
#include "dynamics/nonlinear/adaptive_run.h"
#include "dynamics/response/response.h"
#include <string>
#include <vector>

// The response of a stand on the curves of its contacts to a force record.  theory.md 36.4
namespace mill::dynamics {
/// What the springs of one name did in a run.
struct SpringReach {
  std::string name;     ///< "K3"
  double rest     = 0;  ///< N, at rest, of the whole spring
  double least    = 0;  ///< -, smallest force over that at rest, at any place of it; 0: it parted
  double least_at = 0;  ///< s
  double largest  = 0;  ///< -, largest force over that at rest
  long parted     = 0;  ///< how often a place of it parted
};

/// A response with what only curves have.
struct CurveRun {
  Response response;
  std::vector<SpringReach> springs;  ///< one for each name
  std::vector<SpringEvent> events;   ///< in order of time
  Eigen::VectorXd modal_peak;        ///< (n) kg^1/2 m, largest modal displacement about the mean force
  double work    = 0;                ///< J, largest that the bite force had put in at any time
  double balance = 0;                ///< -, energy less work and loss at the end over that
  long steps     = 0;
};

/// Error-controlled, from rest in the equilibrium under the first sample; outputs as mill_response.
/// @param stand      made from the same modes as `model`
/// @param tolerance  -, see AdaptiveRun
/// @throws SolverError  no equilibrium under the first sample; the integration stops
CurveRun curve_response(const CurveStand &stand, const ModalModel &model, const ForceRecord &force,
                        double output_rate, double tolerance = 1e-10);

/// The same by fixed steps, each of the lengths between samples and outputs in `parts` parts: what an exported
/// unit can do.  No events, no energy.
/// @throws SolverError  a step that could not be solved
CurveRun fixed_step_response(const CurveStand &stand, const ModalModel &model, const ForceRecord &force,
                             double output_rate, int parts = 1);
}  // namespace mill::dynamics
