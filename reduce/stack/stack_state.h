#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::reduce {
/// One contact of two rolls in the solved stack.
struct PairState {
  Eigen::VectorXd z;           ///< m, mill frame, places of the line load
  Eigen::VectorXd weight;      ///< m, of each place in an integral along z
  Eigen::VectorXd load;        ///< N/m
  Eigen::VectorXd tangent;     ///< Pa, d(load)/d(approach)
  Eigen::VectorXd approach;    ///< m, below zero: apart
  double force           = 0;  ///< N
  double load_centre     = 0;  ///< m, z of the resultant
  double peak_load       = 0;  ///< N/m
  double peak_pressure   = 0;  ///< Pa
  double touching        = 0;  ///< share of the length that may touch
  double uniform_tangent = 0;  ///< N/m, integral of the tangent
  double loaded_tangent  = 0;  ///< N/m, d(force)/d(approach that the load weighs), with the rolling force; or NaN
};

/// Deflection of one roll.
struct RollState {
  Eigen::VectorXd z;              ///< m, mill frame
  Eigen::VectorXd x, y;           ///< m, displacement of the axis
  std::vector<double> reactions;  ///< N, along y, of each support on the roll
  std::vector<double> across;     ///< N, the same along x
};

/// The strip and the loaded gap.
struct StripState {
  Eigen::VectorXd edges;    ///< (n + 1) m, from the middle of the strip
  Eigen::VectorXd load;     ///< (n) N/m, mean over an element
  Eigen::VectorXd opening;  ///< (n) m, h - S, mean over an element
  Eigen::VectorXd entry;    ///< (n) m, entry thickness minus its mean over the width
  double middle    = 0;     ///< m, h - S at mid-width
  double crown     = 0;     ///< m
  double edge_drop = 0;     ///< m
  double wedge     = 0;     ///< m
};

struct StackModulus {
  double mid  = 0;  ///< N/m, d(force)/d(h - S) at mid-width
  double mean = 0;  ///< N/m, with h averaged by the line load
};

struct StackState {
  std::vector<PairState> pairs;  ///< as Stack::contacts
  std::vector<RollState> rolls;  ///< as Stack::rolls
  StripState strip;
  StackModulus modulus;
  int newton_steps = 0;
  double residual  = 0;  ///< largest force out of balance over the rolling force
};

/// d(force) over d(approach that the line load weighs) of a contact; NaN where changes of opposite sign along the
/// contact take away half of that of the approach.  theory.md (51.21)
/// @param change  (places of the pair) N/m per N, of its line load with the rolling force
double loaded_tangent(const PairState &pair, const Eigen::VectorXd &change);
}  // namespace mill::reduce
