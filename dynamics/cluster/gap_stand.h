#pragma once
#include "dynamics/cluster/stack.h"

// The stack as the strip sees it: M, K, damping and the row of the gap, as a four-high has them.  theory.md 38.11
namespace mill::cluster {
/// The whole mill about the state at rest, without the spring of the strip: M x'' + K x = b dF, gap change = b .
/// x. n unknowns.  A stack of one half stands for both: mirror images move alike, so that M, K and b are twice
/// those of the half and the unknowns are those of the half that is drawn.
struct GapStand {
  Eigen::VectorXd M;     ///< (n) kg
  Eigen::MatrixXd K;     ///< (n, n) N/m
  Eigen::MatrixXd loss;  ///< (n, n) N/m, contacts (their geometric term left out) and supports
                         ///< times their loss factors
  Eigen::VectorXd b;     ///< (n) -
  std::vector<Eigen::MatrixXd> contacts, supports;  ///< (n, n) N/m, parts of K, in the order of the stack
  std::vector<Eigen::MatrixXd> contact_losses, support_losses;  ///< (n, n) N/m, parts of loss, in that order
};

/// @param upper, lower  rolls at the strip; lower -1: the stack is the upper half
GapStand gap_stand(const Stack &stack, const Motion &rest, int upper, int lower);

/// The stand with the stiffness of some contacts and supports times a factor; their loss factors stay, so that
/// their loss grows with it.
GapStand scaled(GapStand stand, const std::vector<std::size_t> &contacts, const std::vector<std::size_t> &supports,
                double factor);

/// All modes with a spring K4 (N/m) between the rolls at the strip; 0: open.
struct GapStandModes {
  Eigen::VectorXd frequency;  ///< (n) Hz, ascending; a motion that grows has none: 0
  Eigen::MatrixXd shape;      ///< (n, n) mass-normalised
  Eigen::VectorXd damping;    ///< (n) -, ratio of critical: half of the loss factor of the mode, (38.28)
};
GapStandModes modes_of(const GapStand &stand, double K4);

/// The roll at the strip and the rolls that carry it, in one motion; positive away from the strip.
struct StripMotion {
  double work_roll = 0;  ///< of the roll at the strip
  double carrier   = 0;  ///< mean of its neighbours, weighted by the vertical part of what their contacts carry
};
/// @param loads  N, of every contact at rest   @param roll  at the strip   @param away  +1 upper half, -1 lower
StripMotion strip_motion(const Stack &stack, const std::vector<double> &loads, int roll, double away,
                         const Eigen::VectorXd &shape);
}  // namespace mill::cluster
