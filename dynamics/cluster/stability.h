#pragma once
#include "dynamics/cluster/equilibrium.h"
#include <optional>

// How far the stack is from buckling, and from losing a contact.  theory.md 38.7
namespace mill::cluster {
/// Where the smallest eigenvalue of the stack is zero.
struct BucklingLoad {
  double factor = 0;   ///< -, on the rolling force
  std::string motion;  ///< "I x": what grows there
};
/// Smallest factor above 1 at which the stack buckles; nothing up to `largest`.  The state follows the factor.
std::optional<BucklingLoad> buckling_load(Stack stack, double largest = 100);

/// Smallest stiffness of a guide, N/m, with which the stack is stable under its loads; 0: it needs none; nothing:
/// no stiffness of this guide makes it stable.
std::optional<double> least_guide(Stack stack, std::size_t support);

/// A load at which a contact, or a roller behind a roll, that carries force at rest lets go: the roll leaves its
/// nest.
struct LostContact {
  double load = 0;      ///< N
  std::string contact;  ///< "W-L", "L, upper roller"
};
/// A force on one roll, in addition to the loads of the pass, from 0 up along a direction.
/// @param largest  N, where the search ends
std::optional<LostContact> leaving_load(const Stack &stack, int roll, const Eigen::Vector2d &direction,
                                        double largest);
}  // namespace mill::cluster
