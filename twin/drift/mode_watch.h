#pragma once
#include "twin/drift/cusum.h"
#include "twin/drift/mode_fit.h"
#include <limits>
#include <optional>
#include <vector>

// The frequency of a mode against the twin, block after block.  theory.md 50.5
namespace mill::twin {
/// Frequencies of the twin over the rolling force: contacts and bearings stiffen with it.
struct ModesAtLoad {
  Eigen::VectorXd load;       ///< (k) N, rising; one: the same at every load
  Eigen::MatrixXd frequency;  ///< (k, modes) Hz
  Eigen::VectorXd damping;    ///< (modes) -, ratio of critical
  Eigen::VectorXd
      sd;  ///< (modes) -, relative standard deviation of the twin's frequency; 0: calibrated on this stand
  /// Between the loads by straight lines in ln load, outside the end's.
  std::vector<ExpectedMode> at(double force) const;
};

/// One block's word on one mode.
struct ModeRow {
  ModeFit measured;
  ExpectedMode twin;                    ///< at the block's load
  double deviation = ModeFit::unknown;  ///< -, ln(measured/twin) over the standard deviation of both
  double z         = ModeFit::unknown;  ///< -, what is summed: deviation from the reference over the block's own
  double up = 0, down = 0;              ///< -, sums
  bool learning = false;                ///< the reference is not complete yet
  std::optional<Shift> shift;
};

/// Sums the deviations of one mode.  Against the twin itself where it knows the frequency as well as a block does;
/// otherwise against the mean deviation of the first blocks, which is reported as such and not taken for the
/// twin's.
class ModeWatch {
public:
  /// @param twin_sd  -, relative, of the twin's frequency
  explicit ModeWatch(double twin_sd, const CusumRule &rule = {}, int reference_blocks = 12);
  ModeRow take(const ModeFit &measured, const ExpectedMode &twin);
  /// After a change of the twin: sums at zero, a new reference.
  void restart(double twin_sd);
  /// -, ln(measured/twin) of the reference; 0 where the twin itself is it.
  double reference() const;

  enum class Reference { undecided, twin, first_blocks };
  /// What a restarted program goes on from.
  struct State {
    Cusum::State sums;
    Reference reference_is = Reference::undecided;
    int n                  = 0;                ///< blocks of the reference
    double mean = 0, squares = 0, weight = 0;  ///< -, of the reference: mean, weighted squares, sum of weights
    double scatter = 1;  ///< -, of the reference blocks over their own standard deviation, at least one
  };
  State state() const;
  void resume(const State &stored);

private:
  CusumRule rule;
  double twin_sd;
  int wanted;
  Cusum cusum;
  State reference_state;  // its sums are those of `cusum`
};
}  // namespace mill::twin
