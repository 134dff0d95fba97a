#pragma once
#include "dynamics/cluster/stack_of_case.h"
#include <functional>

// Numbers of a stack from frequencies, and how well they are known.  theory.md 38.8
namespace mill::cluster {
struct FittedNumber {
  std::string key;   ///< "support.E.stiffness"
  double start = 0;  ///< SI
  double value = 0;  ///< SI
  double interval =
      0;  ///< SI, half of the 95 % interval; NaN: as many numbers as frequencies, nothing left to judge
};

struct MatchedFrequency {
  std::string mode;
  double wanted   = 0;      ///< Hz
  double computed = 0;      ///< Hz
  bool fitted     = false;  ///< the numbers were chosen for it; else it is a prediction
};

struct StackFit {
  std::string variant;
  std::string pass;
  std::vector<FittedNumber> numbers;
  std::vector<MatchedFrequency> frequencies;  ///< every [[mode]] with a frequency
  Eigen::MatrixXd correlation;                ///< of the numbers; empty where no interval is known
  double rms_fitted    = 0;                   ///< -, relative, of the frequencies that were fitted
  double rms_predicted = 0;                   ///< -, of the others; NaN: no others
  int steps            = 0;
  bool converged       = false;
  std::string undetermined;  ///< a number that the frequencies do not identify; empty: all are identified
  std::string refused;       ///< why the fit failed: an equilibrium that does not exist
};

/// Levenberg-Marquardt on relative errors of frequencies; stiffnesses and loads by their logarithm.  Modes are
/// recognised by their shape in every step.
/// @param force     N, of the pass
/// Cost: (unknowns + 1) equilibria and eigenvalue problems a step, some tens of steps.
StackFit fit_variant(const ClusterStand &stand, const ClusterVariant &variant, const ClusterPass &pass,
                     double force, const ComputedLaws &computed = {});
}  // namespace mill::cluster
