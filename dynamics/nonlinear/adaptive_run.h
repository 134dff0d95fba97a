#pragma once
#include "dynamics/nonlinear/fixed_step.h"
#include <memory>
#include <vector>

namespace mill::dynamics {
/// A spring that parts or touches again.
struct SpringEvent {
  double time        = 0;  ///< s
  std::size_t spring = 0;  ///< in CurveStand::springs
  bool parts         = false;
};

/// ARKODE's explicit Runge-Kutta method of order 8 on the equations of a stand; the only file of this folder that
/// knows SUNDIALS.  A step in which a spring parts or touches is taken again up to that moment, which is found by
/// integration and not on an interpolant.  theory.md 36.4
/// Source: E. Fehlberg, NASA TR R-287 (1968), as ARKODE has it; D. R. Reynolds et al., ACM TOMS 49 (2023).
class AdaptiveRun {
public:
  /// @param stand      kept by reference
  /// @param tolerance  -, error of a step over the size of the motion: that of the largest rest compression
  AdaptiveRun(const CurveStand &stand, const CurveState &start, double time, double tolerance);
  ~AdaptiveRun();
  AdaptiveRun(const AdaptiveRun &)            = delete;
  AdaptiveRun &operator=(const AdaptiveRun &) = delete;

  /// To a later time, under a bite force about its mean that runs from F0 (N) now to F1 then.
  /// @throws SolverError  the step size has to vanish, named with its time
  void advance(double time, double F0, double F1, std::vector<SpringEvent> &events);

  double time() const;
  const double *q() const;  ///< (n) modal displacement
  const double *v() const;  ///< (n) modal velocity
  double work() const;      ///< J, of the bite force about its mean since the start
  double loss() const;      ///< J, what the dampers took since then
  long steps() const;

private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};
}  // namespace mill::dynamics
