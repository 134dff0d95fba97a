#pragma once
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <vector>

namespace mill::bearing {
/// Flexibility of rings, neck and chock as the rollers feel it, beyond the piece of raceway that the law of one
/// roller contains itself.  theory.md 15
///
/// Loads and displacements of a roller on its line are along the raceway's normal and described by Legendre
/// polynomials P_a(2x/L), a < modes.  With N_a = sum_k P_a(x_k) q_k the load density is q(x) = sum_a (2a+1)/L N_a
/// P_a, and the line deflects by w(x) = sum_a w_a P_a, so that sum_k q_k w(x_k) = sum_a N_a w_a.  x runs along
/// the contact line, positive towards greater z.  Positive: the roller presses on the ring and the ring deflects.
struct RingFlexibility {
  int rows = 0, modes = 0;
  /// Bodies of revolution, the cone on its neck and the cup in round surroundings: [m] (rows modes, rows modes)
  /// m/N, index r * modes + a.  A roller load at azimuth psi' moves the line at psi by  sum_m [m] cos m(psi -
  /// psi').
  std::vector<Eigen::MatrixXd> inner, outer;
  /// The cup in a chock, which is not round: harmonics m = 0 .. n-1 (cosine, index (m rows + r) modes + a) and
  /// 1 .. n-1 (sine, index ((m-1) rows + r) modes + a).  The line at psi moves by
  ///     sum cosine[(m..),(m'..)] cos(m psi) cos(m' psi') + sum sine[..] sin(m psi) sin(m' psi')
  /// with psi from the direction in which the chock is supported.  `outer` is zero for these m; the harmonics
  /// beyond are too short to tell a chock from a round housing.
  int chock_harmonics = 0;
  Eigen::MatrixXd chock_cosine;  ///< (n rows modes)^2 m/N
  Eigen::MatrixXd chock_sine;    ///< ((n-1) rows modes)^2 m/N
};

template <class Io, class R, if_record<R, RingFlexibility> = 0> void each_member(Io &&io, R &record)
{
  auto &[rows, modes, inner, outer, chock_harmonics, chock_cosine, chock_sine] = record;
  io("rows", rows);
  io("modes", modes);
  io("inner", inner);
  io("outer", outer);
  io("chock_harmonics", chock_harmonics);
  io("chock_cosine", chock_cosine);
  io("chock_sine", chock_sine);
}

/// (rows Z modes)^2 m/N between all rollers, index (row * Z + roller) * modes + a, inner and outer together.
/// @param azimuth  (Z) rad, of the rollers of every row, from the chock's support
Eigen::MatrixXd flexibility_at(const RingFlexibility &rings, const Eigen::VectorXd &azimuth);

/// The same bodies of a modulus `factor` times as large.
RingFlexibility stiffer(RingFlexibility rings, double factor);

/// `fine` with the surroundings of the cup exchanged: fine + (other - companion) in the first `harmonics` orders,
/// in which a chock differs from a round housing.  Shorter waves do not reach it.
/// @param companion  the bodies of `fine` on the meshes of `other`
/// @throws InputError  another number of rows or modes; fewer than `harmonics` orders
RingFlexibility with_surroundings_of(RingFlexibility fine, const RingFlexibility &companion,
                                     const RingFlexibility &other, int harmonics);

/// (n, modes): P_a at the positions (n, m, from mid-roller) on a roller of this length (m).
Eigen::MatrixXd line_modes(const Eigen::VectorXd &position, double length, int modes);
}  // namespace mill::bearing
