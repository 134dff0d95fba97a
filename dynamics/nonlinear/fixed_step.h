#pragma once
#include "curve_stand.h"

// The stepping kernel for a fixed step.  Standard library alone, as spring_law.h.  theory.md 36.3
namespace mill::dynamics {
/// State of a stand in its modes, and what its springs add to their tangents there.
struct CurveState {
  std::vector<double> q, v;  ///< (n) modal displacement and velocity
  std::vector<double> d;     ///< (s) m, further compression of every spring
  std::vector<double> rho;   ///< (s) N, what it adds to its tangent
  double gap_velocity = 0;   ///< m/s, push . v
};

/// Steps of one length h: every mode by its exact solution under a force that runs in a straight line, the
/// springs' remainders straight lines too, whose end is solved for together with the compressions there (36.7).
/// Implicit, second order in h, exact for a linear stand under first-order hold whatever h is.
class FixedStep {
public:
  /// @param stand  kept by reference
  /// @param h      s, > 0
  /// Cost: n matrix exponentials of 4 x 4, s^2 n.
  FixedStep(const CurveStand &stand, double h);

  /// From the beginning of a step, with bite force F0 about its mean, to its end with F1 (N).
  /// @return  false: the compressions could not be solved for; the state is that of the beginning
  /// Cost: 4 n + 2 s n + some s^2.
  bool advance(CurveState &state, double F0, double F1) const;

private:
  struct Mode {
    double qq, qv, q0, q1, vq, vv, v0, v1;  // end of q and v over start of q and v, force at both ends
  };
  bool solve_end(std::vector<double> &end, const std::vector<double> &explicit_part) const;
  bool newton(std::vector<double> &end, const std::vector<double> &explicit_part) const;
  double force_at(std::size_t j, double end) const;

  const CurveStand &stand_;
  std::vector<Mode> modes_;
  std::size_t n_unknowns_;        // springs, and the gap's velocity where there is a damper
  std::vector<double> response_;  // (u, u) end of unknown i per force of unknown j at the end of a step
  mutable std::vector<double> free_q_, free_v_, explicit_, end_;
};

/// At rest under a constant bite force about its mean (N): Newton's method on the springs.
/// @return  false: no equilibrium was found, as when the force pulls the stand apart
bool rest_under(const CurveStand &stand, double force, CurveState &state);
}  // namespace mill::dynamics
