#pragma once
#include "core/records/stand_model.h"
#include "dynamics/nonlinear/curve_stand.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// A stand in its modes with curves in place of some of its springs.  theory.md 36.2
namespace mill::dynamics {
/// The curve that one connection of a stand follows.
struct ConnectionCurve {
  std::string connection;  ///< of StandModel::connections
  std::string name;        ///< as results have it: "K3"
  SpringLaw law;           ///< of the whole connection
  double load = 0;         ///< N, of the whole connection at rest
};

/// The modes of a stand up to `highest` (Hz) and the springs that follow curves, each place of a line of springs
/// with its share of the law and of the load.  What a spring is compressed by follows from the bite: a force that
/// pushes the work rolls apart compresses every connection but K4, which it relieves.
/// @param frequency  (k) Hz, ascending
/// @param shape      (unknowns, k) kg^-1/2, mass-normalised
/// @throws std::logic_error  a connection that the stand does not have, a law that is not usable
CurveStand curve_stand(const StandModel &stand, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                       const std::vector<ConnectionCurve> &curves, double damping, double highest,
                       double gap_damper);
}  // namespace mill::dynamics
