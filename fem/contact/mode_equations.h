#pragma once
#include "fem/contact/problem.h"
#include <vector>

namespace mill::contact {
/// Right-hand sides that belong to a problem, in the order in which the factor holds them: G, W, gap.
/// Modes are scaled so that the largest entry of each column of G is one: metres and radians then meet as equals.
struct ScaledModes {
  Eigen::MatrixXd rhs;    ///< (n, 2 k + p) [G / scale, W scale, p gaps]
  Eigen::VectorXd scale;  ///< (k) largest |G| of each column
  double compliance = 1;  ///< m/N, typical diagonal entry of C
  int k             = 0;
};

/// @param W           (n, k), or empty: zero
/// @param compliance  m/N, a typical diagonal entry of C
/// @param gaps        (n, p)
ScaledModes scaled_modes(const Eigen::MatrixXd &G, const Eigen::MatrixXd &W, double compliance,
                         const Eigen::MatrixXd &gaps);

/// Loading in scaled modes.
Loading scaled(const Loading &loading, const ScaledModes &modes);

struct ModeState {
  Eigen::VectorXd motion;     ///< (k) scaled
  Eigen::VectorXd resultant;  ///< (k) scaled
  bool determined = true;     ///< false: too few nodes for the free motions; those closest to `near` were taken
  double missing  = 0;        ///< -, what then cannot be balanced, relative to what is imposed
};

/// The k equations that remain when the nodes are eliminated.  With H = G^T C^-1 G, M = 1 + G^T C^-1 W,
/// h = G^T C^-1 gap, all over the active nodes, taken from their Gram matrix:
///     H motion - M resultant = h                                                                 theory.md 9
/// solved for whichever of the two is not imposed.
/// @param gram  (2 k + p, 2 k + p) B_A^T C_AA^-1 B_A
/// @param gap   which of the p gaps
/// @param near  state to stay close to where the equations leave a choice; null: zero
ModeState solve_modes(const Eigen::MatrixXd &gram, const ScaledModes &modes, const Loading &scaled_loading,
                      int gap = 0, const ModeState *near = nullptr);

/// (2 k + p) so that B times it is the closing of the nodes:  G motion - W resultant - gap.
Eigen::VectorXd closing(const ModeState &state, const ScaledModes &modes, int gap = 0);

struct Tangents {
  Eigen::MatrixXd stiffness;   ///< (k, k) d resultant / d motion, M^-1 H, in the user's units
  Eigen::MatrixXd compliance;  ///< (k, k) its inverse H^-1 M; infinite where the stiffness is singular
};
Tangents tangents(const Eigen::MatrixXd &gram, const ScaledModes &modes);

/// Complementarity on the candidates of a border, everything inside held active and everything outside open:
///     S force + reduced gap >= 0 ,   force >= 0 ,   product 0
/// with the modes as k more equations.  Exchanges all nodes that violate a condition at once; should a set return,
/// one at a time by the smallest index, which ends for every P matrix (Murty 1974).
/// @param S, rhs  of the border; (m, m), (m, 2 k + p)
/// @param gram    of what is inside, without the candidates
/// @param start   (m) first guess
/// @param length  m, of the closing inside: what is below 1e-14 of it is not a penetration
/// @return (m) active candidates; empty (while m > 0) when no set was found
std::vector<char> candidates_in_contact(const Eigen::MatrixXd &S, const Eigen::MatrixXd &rhs,
                                        const Eigen::MatrixXd &gram, const ScaledModes &modes,
                                        const Loading &scaled_loading, std::vector<char> start, double length,
                                        int gap = 0);
}  // namespace mill::contact
