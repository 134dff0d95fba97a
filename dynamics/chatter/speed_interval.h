#pragma once
#include "dynamics/chatter/modal_inputs.h"
#include "dynamics/chatter/speed.h"
#include "reduce/bite/linear/linear_sensitivity.h"
#include <string>
#include <vector>

// Where the critical speed lies for what its inputs may be off.  theory.md 27.6
namespace mill::dynamics {
/// Inputs that come from one number and are off by one factor.
struct UncertainNumber {
  std::string name;                        ///< "friction", "K3 and K5"
  double error                       = 0;  ///< -, relative, taken as 1.96 standard deviations of the logarithm
  std::vector<bite::PassNumber> bite = {};
  ModalChange structure              = {};     ///< of a stand in its modes
  bool damping                       = false;  ///< the damping of all modes; dampers of oil films stay
  bool entry_distance = false, exit_distance = false;
};

/// A stand and its bite for which the search has found a critical speed.
struct SpeedQuestion {
  /// In its modes where an input moves its structure: M = I, C that of modal_damping and loss, and dampers
  ChatterStandModel stand;
  double modal_damping = 0;  ///< -, of every mode
  bite::RollBite bite;
  Linearisation scheme = Linearisation::sequential;
  SpeedRange range;
  Eigen::MatrixXd loss = {};  ///< (n, n) 1/s2, loss of DampingOfModes; empty: the modes have one ratio
};

/// What one number does to the interval.
struct SpeedShare {
  std::string name;
  double error = 0;  ///< -, of the number
  double slope = 0;  ///< -, d ln v/d ln p
  double move  = 0;  ///< -, slope times error
};

/// 95 of 100 stands whose inputs are drawn from their errors have their critical speed in it.
struct SpeedInterval {
  double low   = not_given;        ///< m/s; nan: below the range that was searched
  double high  = not_given;        ///< m/s; nan: above it
  double error = 0;                ///< -, of the logarithm by the slopes alone, (27.11)
  std::vector<SpeedShare> shares;  ///< by falling |move|
};

/// The stand and its bite with every number at exp(s_i error_i) times its value.
/// @param s  (numbers) -
SpeedQuestion moved(const SpeedQuestion &question, const std::vector<UncertainNumber> &numbers,
                    const Eigen::VectorXd &s);

/// The speed next to `near` where the growth rate changes its sign upward; nan: none in the range.  The search
/// goes outwards in steps of 4 %.
/// Cost: some 10 eigenproblems
double crossing_near(const SpeedQuestion &question, double near);

/// Ends are critical speeds of the program at two sets of inputs: the two likeliest at the border of the 95 %,
/// (27.12), so that the bend of the speed over the inputs is in them.
/// @param critical  of question, Verdict::crossing
/// Cost: slopes, and two calls of crossing_near
SpeedInterval speed_interval(const SpeedQuestion &question, const StandSpeed &critical,
                             const std::vector<UncertainNumber> &numbers);
}  // namespace mill::dynamics
