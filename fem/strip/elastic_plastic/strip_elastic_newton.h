#pragma once
#include "fem/strip/common/unsymmetric_factor.h"
#include "fem/strip/elastic_plastic/strip_elastic_equations.h"

// Newton's method on the elastic-plastic strip, and the ways to its last level.  theory.md 19.5
namespace mill::fem {
/// Newton's method on one grid, with what has converged last.
class ElasticContinuation {
public:
  ElasticContinuation(const ElasticPass &pass, ElasticGrid &grid, const ElasticRoll &roll, Eigen::VectorXd start,
                      StripCourse &course);
  /// One level; on failure the unknowns stay what they were.
  /// @param leaps  where no step lowers the residual: half a step up; false: a small one
  bool newton(ElasticStage stage, const char *what, int steps = 40, bool leaps = true);
  /// From the last level to another one, in as many parts as it takes.
  bool advance(const ElasticStage &target, const char *what, int depth = 0);

  const ElasticPass &pass;
  ElasticGrid &grid;
  const ElasticRoll &roll;
  Eigen::VectorXd u;
  ElasticStage reached;          ///< where it converged last
  bool fits            = false;  ///< lines of the mesh shall end the contact
  double last_residual = 0;      ///< -

private:
  bool is_last(const ElasticStage &stage) const;
  double tolerance(const ElasticStage &stage) const;
  bool find_thinnest(ElasticStage &stage) const;
  double largest_share(const Eigen::VectorXd &d) const;
  UnsymmetricFactor factor;
  RowMemory memory;
  StripCourse &course;
};

/// First and last spine where the pressure outweighs the gap, which of a smoothed contact (19.12) is where it is
/// larger than the root of the softness; -1: none.
std::pair<int, int> spines_in_contact(const ElasticGrid &grid, const Eigen::VectorXd &unknowns, double softness);

/// g0 at which the mesh is fitted to the contact: the strip is still regularised, so no point changes between
/// elastic and plastic when the mesh moves.
constexpr double fit_rate = 0.01;

/// Down from a regularised strip at rate `from`, everything else as at the end, to `until`; 0: to the last level.
/// @throws SolverError  no convergence
void harden(ElasticContinuation &c, double from, double until = 0);
/// From an even flow.  @throws SolverError  no convergence
void solve_cold(ElasticContinuation &c, double until = 0);
/// From a state of another mesh or pass: the last level at once, or from a regularised strip on.
/// @throws SolverError  no convergence
void solve_warm(ElasticContinuation &c);
ElasticStage last_stage(const ElasticPass &pass);
}  // namespace mill::fem
