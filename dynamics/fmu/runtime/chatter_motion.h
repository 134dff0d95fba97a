#pragma once
#include "chatter_data.h"
#include "roll_bite.h"
#include <string>
#include <vector>

namespace mill::fmu {
/// The vibration about the steady state of the bite.
struct ChatterState {
  std::vector<double>
      z;  ///< (2n + 2): x, x', and the stretch of both spans as stresses (Pa) in addition to the steady ones
  bool strip_held  = true;  ///< the strip is between the rolls
  double next_step = 0;     ///< s, proposed by the last error estimate
  double events    = 0;     ///< edges crossed so far
};

/// A force in addition to that of the bite, along a straight line over a step, and a held entry thickness.
struct ChatterInput {
  double force = 0, slope = 0;  ///< N at the beginning, N/s
  double entry_thickness = 0;   ///< m, in addition to the steady one
};

/// Stand, bite and strip between the stands, nonlinear (26.4), by an embedded pair of Runge-Kutta formulas of
/// order 5 and 4 with error control.  A sign that changes (slack strip, strip that leaves the rolls, skidding,
/// rolls that separate) is located, and a new step begins there.  theory.md 37
class ChatterMotion {
public:
  /// @throws std::runtime_error  no steady state of the bite
  ChatterMotion(const ChatterData &data, const PassData &pass);

  const RollBite &bite() const
  {
    return bite_;
  }
  std::size_t unknowns() const
  {
    return n_;
  }
  /// Both work rolls away from the strip by a distance (m), all else at rest.
  ChatterState displaced(double distance) const;

  /// Moves over `length` (s).  Empty, or why it cannot go on; the state then is where that happened, `length` what
  /// was reached.
  std::string advance(ChatterState &state, double &length, const ChatterInput &input) const;

  /// What can be read of a state under the force that acts now.
  struct Reading {
    BiteReading bite;
    double gap           = 0;                        ///< m, change
    double entry_tension = 0, exit_tension = 0;      ///< Pa, total
    std::vector<double> acceleration, displacement;  ///< (m) of the points, away from the strip
  };
  Reading read(const ChatterState &state, const ChatterInput &input) const;

private:
  BiteMoment moment_of(const double *z, const ChatterInput &input) const;
  BiteReading answer(const double *z, bool held, const ChatterInput &input) const;
  void slope(const double *z, bool held, double time, const ChatterInput &input, double *derivative) const;
  double try_step(const std::vector<double> &z, bool held, double time, double h, const ChatterInput &input,
                  std::vector<double> &result) const;
  void edges(const double *z, bool held, const ChatterInput &input, std::vector<double> &value) const;
  std::string refusal(const double *z, const ChatterInput &input) const;
  double pressing(std::size_t contact, const double *z) const;

  const ChatterData &data_;
  PassData pass_;
  RollBite bite_;
  std::size_t n_, contacts_;
  double entry_, exit_;  // Pa/m, modulus over length
  double impedance_;     // Pa s/m, of waves along the strip
  mutable std::vector<double> stage_[7], trial_;
};
}  // namespace mill::fmu
