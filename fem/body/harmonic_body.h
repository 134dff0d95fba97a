#pragma once
#include "core/model/ring_sections.h"
#include "fem/body/section_body.h"
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// A body of revolution under loads  f_r cos(m theta), f_theta sin(m theta), f_z cos(m theta),  order by order. It
/// is held at the group "held"; without that group it is free: the loads of orders 0 and 1 are then balanced by a
/// body force distributed over the volume like the rigid motions, and displacements count from the mean rigid
/// motion of the volume.  A group "axis" is kept single-valued.  theory.md 15
class HarmonicBody {
public:
  explicit HarmonicBody(const SectionBody &section);

  /// (k, k) m/N, symmetric: displacements along the loads (generalised, work over the whole circumference) of the
  /// loads (3 N, k) N, unknown 3 n + c as in SectionBody::harmonic_stiffness.
  /// @throws SolverError  rigid motions left: a body held too little
  /// Cost: one factorisation.
  Eigen::MatrixXd flexibility(int m, const Eigen::MatrixXd &loads) const;

  /// (3 N, nr): the rigid motions of order m of a free body: m = 0 axial; m = 1 translation along theta = 0 and
  /// tilt z u_r - r u_z; none beyond.
  Eigen::MatrixXd rigid_motions(int m) const;
  /// (N) m3: share of every node in the volume.
  const Eigen::VectorXd &volumes() const;
  bool is_free() const;
  int n_unknowns() const;  ///< 3 N

private:
  std::vector<char> supports(int m) const;
  const SectionBody &body;
  std::vector<int> axis, held;
  Eigen::VectorXd volume;
};

/// (3 N, modes) N: a line load on a raceway of a meridian section, of unit amplitude in each Legendre polynomial,
/// (2a + 1)/L P_a(2x/L) per length along the raceway's normal, outwards (sign +1) or inwards (-1).  Its product
/// with a displacement is the a-th Legendre coefficient of the displacement along the load.
/// @param group  boundary lines on the contact line, from end to end
Eigen::MatrixXd raceway_loads(const SectionBody &body, const std::string &group, const RacewayLine &line,
                              double length, int modes, int sign);
/// (modes): Legendre polynomials at s in -1..1.
Eigen::VectorXd legendre(double s, int modes);
/// Shape functions of a line of 2 or 3 nodes at s in 0..1.
Eigen::VectorXd line_shape(Eigen::Index n_nodes, double s);
}  // namespace mill::fem
