#pragma once
#include "fem/contact/problem.h"
#include <memory>
#include <vector>

namespace mill::contact {
/// Coulomb contact of condensed bodies.  Components: the n normal ones, then n along the first tangent, then n
/// along the second (space) or none (plane); d tangents.
///     opening = (initial_gap, 0) + C nodal + W resultant - G motion ,   G^T nodal = resultant
/// Normal: opening >= 0, nodal >= 0, product 0.  Tangential: the slip is minus the opening, so that a driven
/// motion is resisted by forces along it.
struct FrictionProblem {
  Eigen::MatrixXd C;            ///< (n + d n, n + d n) m/N, symmetric, positive definite, coupling blocks included
  Eigen::MatrixXd G;            ///< (n + d n, k) closing and slip per unit of each motion
  Eigen::MatrixXd W;            ///< (n + d n, k) or empty, opening by what balances a unit of each resultant
  Eigen::VectorXd initial_gap;  ///< (n) m
  Eigen::VectorXd mu;           ///< (n) -, coefficient of friction, >= 0
};

enum class Status : char {
  open,   ///< gap >= 0, no force
  stick,  ///< gap = 0, no slip in this step, |tangential| <= mu normal
  slip    ///< gap = 0, tangential = mu normal along the slip of this step
};

struct FrictionState {
  Eigen::VectorXd motion;     ///< (k) m, rad
  Eigen::VectorXd resultant;  ///< (k) N, N m
  Eigen::VectorXd nodal;      ///< (n + d n) N, normal >= 0
  Eigen::VectorXd gap;        ///< (n) m, >= 0
  Eigen::VectorXd slip;       ///< (d n) m, since the beginning of the path, of open nodes too
  Eigen::VectorXd increment;  ///< (d n) m, slip of this step
  Eigen::MatrixXd
      stiffness;  ///< (k, k) d resultant / d motion, status of all nodes held, consistent with the step
  std::vector<Status> status;  ///< (n)
  double dissipated = 0;       ///< J, tangential forces times slip of this step, >= 0
  double residual   = 0;       ///< -, largest violation of all conditions, relative
  int iterations    = 0;
};

/// Follows a path of loadings; the state of one loading is where the next begins.  The load path matters: a node
/// that slips in a step does so along the slip of the step as a whole (implicit), so the steps are part of the
/// model.
///
/// Each step: a semismooth Newton method (Alart and Curnier 1991) on the nodes that touch; in the plane it is an
/// exchange of status and ends on the exact one.  If it does not end, friction bounds are frozen at mu times the
/// last normal forces and updated (Panagiotopoulos 1975), and the Newton method closes from there.
/// theory.md 9
class FrictionSolver {
public:
  /// @throws InputError  sizes that do not fit, no d of 1 or 2, NaN, mu < 0
  explicit FrictionSolver(FrictionProblem problem);
  ~FrictionSolver();
  FrictionSolver(FrictionSolver &&) noexcept;

  /// The next step.  On an exception the state stays where it was.
  /// @throws InputError   loading of another size, NaN
  /// @throws SolverError  the resultants exceed what friction carries (everything slides); no status found
  /// Cost per iteration: LU factorisation of (1 + d) a unknowns, a nodes in contact.
  const FrictionState &advance(const Loading &loading);

  /// Unloaded and without slip.
  void reset();
  const FrictionState &state() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::contact
