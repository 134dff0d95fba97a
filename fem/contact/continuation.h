#pragma once
#include "fem/contact/active_factor.h"
#include "fem/contact/active_set.h"
#include "fem/contact/mode_equations.h"
#include <functional>

namespace mill::contact {
/// Where the set of a path changes, or where the path begins or ends.
struct Event {
  double position = 0;               ///< -, 0 .. 1 along the path
  Eigen::VectorXd motion;            ///< (k) m, rad
  Eigen::VectorXd resultant;         ///< (k) N, N m
  Eigen::MatrixXd stiffness_before;  ///< (k, k) d resultant / d motion on the side of smaller `position`
  Eigen::MatrixXd stiffness_after;   ///< (k, k) on the side of larger `position`
  std::vector<int> entered;          ///< nodes that touch from here on
  std::vector<int> left;             ///< nodes that are open from here on
};

/// Motion and resultant as exact piecewise linear functions of the loading.
struct Path {
  std::vector<Event> events;  ///< ascending; the first begins and the last ends the path
};

struct PathPoint {
  Eigen::VectorXd motion;     ///< (k) m, rad
  Eigen::VectorXd resultant;  ///< (k) N, N m
  Eigen::MatrixXd stiffness;  ///< (k, k) d resultant / d motion of the piece; at an event that of the piece after
};

/// Follows the contact from one loading to another that imposes the same modes in the same way; in between the
/// loading is interpolated.  No step is chosen: between two changes of the active set everything is linear, and
/// the next change is where a force or a gap reaches zero.  Nodes that change together are sorted by the
/// complementarity problem of the derivatives, so that a tie (a flat punch) neither cycles nor needs a
/// perturbation.  theory.md 9
///
/// On return the solver holds the set of the end.
/// @throws InputError   drives that impose different modes
/// @throws SolverError  as ActiveSet::solve at the start; an equilibrium lost on the way
/// Cost: per event one product with C and two triangular solves, O(n^2).
Path follow(ActiveSet &solver, const Loading &from, const Loading &to);

/// @throws InputError  `position` outside 0 .. 1
PathPoint sample(const Path &path, double position);

/// The same, for a gap that changes along with the loading: gaps 0 and 1 of the modes are the constant and the
/// linear part.  Calls `seen` at every event; the factor ends with the set of the end.
/// @param start     modes at 0, which are kept where too few nodes touch to determine a free motion
/// @param touching  nodes without force and without gap at the start: their status is found here
struct PathStep {
  double position;  ///< -, 0 .. 1
  ModeState constant, linear;
  Eigen::MatrixXd gram_before, gram_after;
  std::vector<int> entered, left;
};
void follow_path(ActiveFactor &factor, const ScaledModes &modes, const Loading &constant, const Loading &linear,
                 const ModeState &start, const std::vector<int> &touching,
                 const std::function<void(const PathStep &)> &seen);
}  // namespace mill::contact
