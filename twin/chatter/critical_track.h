#pragma once
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/chatter/speed.h"
#include <array>
#include <complex>
#include <limits>
#include <string>
#include <vector>

// Critical speed at the inputs of every second, from the one before.  theory.md 50.6
namespace mill::twin {
/// The stand whose bite is followed.
struct ChatterModel {
  dynamics::ChatterStandModel stand;
  bite::RollBite bite;  ///< the case's; thicknesses and tensions are replaced by what is measured
  Linearisation scheme = Linearisation::sequential;
  dynamics::SpeedRange range;
  std::vector<dynamics::StructureNumber> numbers;  ///< of the stand, for the interval; may be empty
};

/// What the mill runs at; NaN: not measured, the case's.
struct ChatterInputs {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double entry_thickness = none, exit_thickness = none;  ///< m
  double entry_tension = none, exit_tension = none;      ///< Pa
  double width = none;                                   ///< m
};
bite::RollBite with_inputs(bite::RollBite bite, const ChatterInputs &inputs);

/// Relative standard deviation of an input, by the key of a case file.
struct InputDoubt {
  std::string
      key;        ///< "condition.entry_tension", "stand.dampings"; a beginning of it stands for all that begin so
  double sd;      ///< -
  bool streamed;  ///< measured with the speed; false: a number of the model
};
/// Assumed where no better values are stated: thicknesses 0.5 %, tensions 3 %, friction and oil 10 %, flow stress
/// 3 %, masses 2 %, springs 5 %, dampings 30 %, distances 1 %.
const std::vector<InputDoubt> &usual_doubts();

/// One solution.
struct CriticalPoint {
  double speed     = ChatterInputs::none;  ///< m/s
  double frequency = ChatterInputs::none;  ///< Hz
  std::complex<double> root;               ///< 1/s, on the axis but for rounding
  double slope = ChatterInputs::none;      ///< 1/s per m/s, of its real part: above zero
};

/// Its interval.
struct CriticalInterval {
  double streamed = ChatterInputs::none;  ///< -, relative standard deviation by what is measured
  double model    = ChatterInputs::none;  ///< -, by the numbers of the model
  double low = ChatterInputs::none, high = ChatterInputs::none;  ///< m/s, 95 % by both
  std::string largest;                                           ///< input that adds most, in words
  double largest_share = 0;                                      ///< -, of the variance
};

/// Follows one critical speed from inputs to inputs.
class CriticalTrack {
public:
  explicit CriticalTrack(ChatterModel model);

  /// Starts, or starts again, from a search of the whole range at these inputs.
  /// @param found  verdict crossing; otherwise there is nothing to follow until the next search
  void begin(const dynamics::CriticalSpeed &searched);
  bool following() const;

  /// The critical speed at other inputs: secant steps on the real part of the same root, the steady bite solved at
  /// every one of them.  Accepted when that root alone reaches the axis there, upward and next to its last
  /// position, and when the stand is stable at one more speed below, another one each time (16 over the range).
  /// @returns false: lost; why() says it, and a search of the range is needed
  /// Cost: 3 to 4 working points and eigenproblems, 0.4 ms.
  bool follow(const bite::RollBite &bite);
  const CriticalPoint &point() const;
  const std::string &why() const;

  /// At the last point, by the exact slopes of theory.md 27.  Cost: 0.5 ms.
  CriticalInterval interval(const bite::RollBite &bite, const std::vector<InputDoubt> &doubts) const;

  /// 1/s, largest real part at a speed; NaN: no steady bite there.
  double growth_at(const bite::RollBite &bite, double speed) const;

  const ChatterModel model;

private:
  CriticalPoint last;
  std::string lost = "not searched yet";
  int below        = 0;  // which of the speeds below is looked at next
};

/// Relative difference of the critical speeds by the three linearisations of the bite, half of their range: what
/// no interval of inputs contains.  NaN: one of them has none.  Cost: three searches, 25 ms.
double scheme_spread(const ChatterModel &model, const bite::RollBite &bite);
}  // namespace mill::twin
