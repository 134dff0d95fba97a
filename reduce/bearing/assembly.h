#pragma once
#include "core/base/each_member.h"
#include "core/base/errors.h"
#include "core/model/roller_bearing.h"
#include "reduce/bearing/ring_flexibility.h"
#include "reduce/bearing/roller_law.h"
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

// The assembled bearing: rows x rollers x slices between rings that may deflect.  theory.md 5.5
namespace mill::bearing {
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// What is assembled: geometry, law of one roller, flexibility of the rings (rows = 0: rigid rings).
/// Axes: x towards the support of the chock, z along the axis, y so that x, y, z is right-handed.
struct BearingModel {
  RollerBearing bearing;
  RollerLaw roller;
  RingFlexibility rings;
  double cage_angle        = 0;  ///< rad, azimuth of roller 0 of every row from x
  double centrifugal_force = 0;  ///< N, of one roller, m d_m omega_c^2 / 2: sets the least load on the cup
};

/// Law and geometry of the bearing with rigid rings; "fe" is refused as by roller_law.
BearingModel rigid_model(const RollerBearing &bearing);

/// Imposed on the inner ring: load or motion for each of  x, y, z, rotation about x, rotation about y.
struct RingLoading {
  Vector5 value                  = Vector5::Zero();  ///< N, N m where a load is imposed; m, rad where a motion is
  std::array<bool, 5> prescribed = {false, false, true, true, true};
};
/// Radial load along x (N); axial motion zero, tilt (rad) about y imposed.
RingLoading radial_drive(double load, double tilt = 0);
/// For messages: "F_x = 1000 kN, tilt about y = 0.5 mrad"; what is zero is left out.
std::string loading_text(const RingLoading &loading);

/// One equilibrium.
struct AssemblyState {
  Vector5 motion = Vector5::Zero();  ///< m, rad, of the inner ring (mean motion of the neck) against the support
  Vector5 load   = Vector5::Zero();  ///< N, N m, on the inner ring, in equilibrium
  Matrix5 tangent;                   ///< N/m, N, N m: d load / d motion, exact, rings deforming; symmetric
  Eigen::MatrixXd roller_load;       ///< (rows, Z) N, normal to the cup's raceway
  Eigen::MatrixXd roller_moment;     ///< (rows, Z) N m, of the slice loads about mid-roller
  Eigen::MatrixXd
      roller_approach;  ///< (rows, Z) m, mean over the roller, raceway to raceway, ring bending taken off
  Eigen::MatrixXd roller_tangent;  ///< (rows, Z) N/m, of the roller between its raceways, at even approach
  Eigen::MatrixXd slice_load;      ///< (n, rows Z) N, column row * Z + roller
  Eigen::MatrixXd inner_load;      ///< (rows, Z) N, normal to the cone's raceway
  Eigen::MatrixXd rib_force;       ///< (rows, Z) N, on the big end; unilateral stop, frictionless
  Eigen::VectorXd row_radial;      ///< (rows) N, force of the row along the total radial load
  Eigen::VectorXd row_axial;       ///< (rows) N, in z
  Eigen::VectorXd row_share;  ///< (rows) -, of the radial load; negative: loaded on the far side; 0 without it
  Eigen::VectorXi loaded_rollers;  ///< (rows), rollers that both raceways press, by more than rounding: carries()
  Eigen::VectorXd azimuth;         ///< (Z) rad, from the support
  Eigen::VectorXd ring_motion;     ///< (rows Z modes) m, how far the rings deflect; empty: rigid
  int iterations  = 0;
  double residual = 0;  ///< -, largest of the equilibrium, relative to the load
};

template <class Io, class R, if_record<R, AssemblyState> = 0> void each_member(Io &&io, R &record)
{
  auto &[motion, load, tangent, roller_load, roller_moment, roller_approach, roller_tangent, slice_load,
         inner_load, rib_force, row_radial, row_axial, row_share, loaded_rollers, azimuth, ring_motion, iterations,
         residual] = record;
  io("motion", motion);
  io("load", load);
  io("tangent", tangent);
  io("roller_load", roller_load);
  io("roller_moment", roller_moment);
  io("roller_approach", roller_approach);
  io("roller_tangent", roller_tangent);
  io("slice_load", slice_load);
  io("inner_load", inner_load);
  io("rib_force", rib_force);
  io("row_radial", row_radial);
  io("row_axial", row_axial);
  io("row_share", row_share);
  io("loaded_rollers", loaded_rollers);
  io("azimuth", azimuth);
  io("ring_motion", ring_motion);
  io("iterations", iterations);
  io("residual", residual);
}

/// Radial stiffness along the radial load, N/m: loads of the other load-driven components kept, motions of the
/// motion-driven ones kept.  Without a radial load along x.
double radial_tangent(const AssemblyState &state, const RingLoading &loading);
/// d F / d u along one axis (0..4), N/m, or N m for the turns (3, 4): loads of the other load-driven components
/// kept, motions of the motion-driven ones kept.
double stiffness_along(const AssemblyState &state, const RingLoading &loading, int axis);
/// Radial load over the motion along it, from the concentric position, N/m.
double radial_secant(const AssemblyState &state);

/// States over a list of loadings, until one has no solution.
struct AssemblyCurve {
  std::vector<AssemblyState> states;           ///< of the loadings that converged, in order
  std::optional<SolverError::Report> failure;  ///< why the next one did not; names its load
};

/// Equilibrium of the bearing under any mix of imposed loads and motions; keeps the last state as a start.
///
/// Roller at azimuth psi in a row of hand s, cup angle a, slice at x along the contact line:
///   approach = n . (motion of the inner ring there) + offset - ring bending
///   n        = (cos a cos psi, cos a sin psi, s sin a)
/// The offset is what clearance or end play takes or what preload gives.  A turn of the ring moves the raceway's
/// rim axially too, by the radius times the turn: (p x n), in the approach and in the moments. The energy is
/// convex, so Newton's method with the exact second derivative and a line search on the slope of the energy finds
/// the one equilibrium from any start. Source: ISO/TS 16281; T. C. Lim, R. Singh, J. Sound Vib. 139 (1990) 179.
class BearingAssembly {
public:
  /// @throws InputError   apex condition not closed by more than 0.5 deg; several rows without width; arrangement
  ///                      unknown; flexibility of another number of rows; preload on a radial bearing
  /// @throws SolverError  no offsets of the rows give the preload
  explicit BearingAssembly(BearingModel model);
  ~BearingAssembly();
  BearingAssembly(BearingAssembly &&) noexcept;

  /// @throws InputError   a loading that is not finite
  /// @throws SolverError  no roller carries a load that has to be carried; no equilibrium (a row that is pushed
  ///                      out axially); 200 steps.  Says how it stood; the state before is kept.
  /// Cost per Newton step: rows Z roller laws, and (rank)^3 / 3 for elastic rings, rank at most loaded rollers x
  /// modes.  4 x 39 rollers of 41 slices, 5 steps: 1 ms by a power law, 15 ms with elastic rings, 50 ms with a
  /// line-contact law.
  AssemblyState solve(const RingLoading &loading);

  /// Loadings in turn, each from the state before.  A loading without a solution ends the curve; it does not
  /// throw.
  AssemblyCurve curve(const std::vector<RingLoading> &loadings);

  /// The next solve starts cold.
  void forget();
  /// Cage turned to another angle, rad; the flexibility is set up again, the last state is kept as a start.
  void turn_cage(double angle);

  const BearingModel &model() const;
  /// (rows) m, what clearance, end play or preload adds to the approach of every roller of a row.
  const Eigen::VectorXd &offset() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};

/// What changes while the cage turns by one pitch.
struct CageVariation {
  Eigen::VectorXd angle;    ///< (n) rad, of the cage, 0 .. one pitch without its end
  Eigen::VectorXd tangent;  ///< (n) N/m, radial_tangent
  Eigen::VectorXd secant;   ///< (n) N/m, radial_secant
};
/// @throws InputError  n < 1; SolverError as solve
CageVariation cage_variation(const BearingModel &model, const RingLoading &loading, int n);
}  // namespace mill::bearing
