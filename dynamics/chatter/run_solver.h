#pragma once
#include "dynamics/chatter/equations.h"
#include <memory>
#include <string>
#include <vector>

namespace mill::dynamics {
/// CVODE on the nonlinear equations; the only file of chatter that knows SUNDIALS.
class ChatterIntegrator {
public:
  /// @param equations  kept by reference
  /// @param tolerance  -, relative; absolute: that of the size of the start, at least of a gap change of 1 nm
  ChatterIntegrator(ChatterEquations &equations, const Eigen::VectorXd &start, double tolerance);
  ~ChatterIntegrator();

  struct Reached {
    double time;               ///< s
    std::vector<int> crossed;  ///< per edge: -1 now negative, +1 now positive, 0 not crossed; empty: none was
    std::string failure;       ///< why it cannot go on; empty if it can
  };
  /// Moves to a time, or to the first edge before it; `restart` before going on from there.
  Reached advance(double time);
  void restart(double time);
  const double *state() const;
  long steps() const;

private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};
}  // namespace mill::dynamics
