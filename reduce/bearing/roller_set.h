#pragma once
#include "reduce/bearing/assembly.h"
#include "reduce/bearing/roller_places.h"

namespace mill::bearing {
/// All rollers at given approaches: what each carries and how it stiffens, by Legendre polynomials along the line.
/// N_a = sum_k P_a(x_k) q_k works through the a-th coefficient of the approach.
struct RollerForces {
  Eigen::VectorXd load;          ///< (rollers modes) N, N_a
  Eigen::MatrixXd slope;         ///< (modes, rollers modes) N/m, block j: dN/d(approach) of roller j, symmetric
  Eigen::MatrixXd slice_load;    ///< (n, rollers) N
  std::vector<char> on_raceway;  ///< (rollers) pressed by both raceways
};

/// The law of one roller, applied to every roller of a bearing.
class RollerSet {
public:
  /// @param least  N, load below which a roller rests on the cup alone, by its centrifugal force, without
  /// stiffness
  RollerSet(RollerLaw law, double roller_length, int modes, double least);

  /// @param approach  (rollers modes) m, coefficients along the line
  /// @param start     forces near by, or nullptr
  RollerForces forces(const Eigen::VectorXd &approach, const RollerForces *start) const;

  /// (modes): N_a of a unit load spread evenly.
  Eigen::VectorXd even_load() const;
  const RollerLaw &law() const;

private:
  RollerLaw law_;
  Eigen::MatrixXd shape_;  // (n, modes) P_a at the slices
  double least_;
};

/// Forces between cup, cone and rib of one roller that its cup presses with `cup` (N): equilibrium of three
/// frictionless contacts and the centrifugal force.  Source: Zhang, Lv, Han, Li, Sensors 23 (2023) 4967.
struct RollerTriangle {
  double cone;  ///< N, normal to the inner raceway, not negative
  double rib;   ///< N, on the big end, not negative: the rib can only push
};
RollerTriangle roller_triangle(const RollerBearing &bearing, double cup, double centrifugal = 0);

/// N, load of the cup on a roller that has left the cone and is held by rib and centrifugal force alone.
double least_cup_load(const RollerBearing &bearing, double centrifugal);

/// Whether a roller carries: more than 1e-9 of the heaviest one.  A roller at right angles to the load is pressed
/// by the rounding of its cosine alone, some 1e-18 of that.
bool carries(double load, double heaviest);

/// rad, of the rib's normal against the radial direction's normal: the given one, else along the roller's axis,
/// 90 deg less the angle of that axis.
double rib_angle(const RollerBearing &bearing);
}  // namespace mill::bearing
