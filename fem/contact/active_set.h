#pragma once
#include "fem/contact/problem.h"
#include <memory>
#include <vector>

namespace mill::contact {
class ActiveFactor;
struct ScaledModes;

/// Exact solver of a contact problem; keeps the active set and its Cholesky factor from one loading to the next.
///
/// Each iteration evaluates the conditions on all nodes with the present set.  Then it solves exactly for the
/// nodes in doubt (those that violate a condition, and those whose force or gap is nearest to zero) with all
/// others held. It ends when every node satisfies its condition: neither a tolerance nor a penalty has to be
/// chosen. A cold start takes its set from the same problem on groups of neighbouring nodes.  When the exchange
/// does not end, the set is followed from a known equilibrium by continuation (continuation.h), which ends for
/// every positive definite C.  Chapter 9 of docs/theory.md
///
/// Example:
///   ActiveSet solver({C, G, {}, gap});
///   for (double force : loads)
///     curve.push_back(solver.solve({Eigen::VectorXd::Constant(1, force)}).motion[0]);
class ActiveSet {
public:
  /// Keeps the problem as its own; pass it with std::move to avoid a copy of C.
  /// @throws InputError  sizes that do not fit, NaN or infinity, a diagonal of C not positive
  explicit ActiveSet(Problem problem);
  ~ActiveSet();
  ActiveSet(ActiveSet &&) noexcept;

  /// @param start  (n) a set to begin with; empty: the set of the last solve, or a cold start if there was none
  /// @throws InputError   loading of another size, NaN
  /// @throws SolverError  the resultants need tension; their line of action lies outside the contact; all motions
  ///                      are free and nothing presses; too few nodes to hold a free motion; C not positive
  ///                      definite
  /// All motions imposed and no node touching is a state: nodal 0, stiffness 0, compliance infinite.  A resultant
  /// of zero on a single mode that only closes: the bodies just touch.
  /// Cost: per iteration one product with C and about a^2 m, a active nodes, m in doubt; a cold start a^3 / 3
  /// more.
  State solve(const Loading &loading, const std::vector<char> &start = {});

  /// Another initial gap (crown, wear, thermal profile), same bodies: nothing is factorised again.  (n) m
  /// @throws InputError  size, NaN
  void set_gap(const Eigen::VectorXd &initial_gap);
  /// The next solve starts cold.
  void forget();

  const Problem &problem() const;

  /// The parts that continuation works on; gap 1 of the modes is zero.
  ActiveFactor &factor();
  const ScaledModes &modes() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::contact
