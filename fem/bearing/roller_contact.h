#pragma once
#include "core/base/each_member.h"
#include "core/base/errors.h"
#include "core/model/roller_setup.h"
#include "core/process/progress.h"
#include "fem/contact/problem.h"
#include "fem/roll/condensed_roll.h"
#include <Eigen/Core>
#include <functional>
#include <memory>

// One roller between a convex and a concave raceway by contact finite elements.  theory.md 14
namespace mill::fem {
/// Flexibilities of the three bodies on one grid of stations, from which every load is solved.  Displacements
/// along the common normal into the body under forces that press on it, on the half x >= 0.
struct CondensedRoller {
  RollerSetup setup;
  PatchGrid grid;  ///< x >= 0, both sides of mid-length; node i_z * n_x + i_x
  struct Parities {
    Eigen::MatrixXd even;  ///< (m, m) m/N, m nodes with z >= 0; about mid-length
    Eigen::MatrixXd odd;   ///< (m, m) m/N
  };
  Parities symmetric,
      antisymmetric;        ///< of the roller: both lines pressed towards its axis, or pushed the same way
  Parities inner, outer;    ///< of the raceways, held at their backs
  int n_unknowns      = 0;  ///< of the roller and both raceways, one symmetry case of each
  double factor_bytes = 0;  ///< bytes, largest factor
};

template <class Io, class R, if_record<R, CondensedRoller::Parities> = 0> void each_member(Io &&io, R &record)
{
  auto &[even, odd] = record;
  io("even", even);
  io("odd", odd);
}

template <class Io, class R, if_record<R, CondensedRoller> = 0> void each_member(Io &&io, R &record)
{
  auto &[setup, grid, symmetric, antisymmetric, inner, outer, n_unknowns, factor_bytes] = record;
  io("setup", setup);
  io("grid", grid);
  io("symmetric", symmetric);
  io("antisymmetric", antisymmetric);
  io("inner", inner);
  io("outer", outer);
  io("n_unknowns", n_unknowns);
  io("factor_bytes", factor_bytes);
}

/// Condenses the three bodies: eight factorisations.
/// @param meshes  of meshes::mesh_roller for the same setup
/// @throws InputError   sizes that are missing or contradict each other, meshes that cannot be read
/// @throws SolverError  meshes that do not match each other, a factorisation that failed
/// Cost: some ten seconds.
CondensedRoller condense_roller(const RollerSetup &setup, const RollerMeshes &meshes,
                                const Progress &progress = {});

/// The whole length from half of it; node i_z * n_x + i_x.
PatchGrid both_sides(const PatchGrid &half);
/// (n, n) m/N on all nodes of the whole length.  @param n_x  nodes across
Eigen::MatrixXd both_sides(const CondensedRoller::Parities &half, int n_x);
/// (2n, 2n) m/N: closing that forces on all nodes undo, those of the inner contact first; roller and raceway
/// together. The roller is held against its free motions where no balanced load presses on the holder.
Eigen::MatrixXd pair_flexibility(const CondensedRoller &roller);

/// One of the two contacts of a solved roller.
struct RollerSide {
  Eigen::MatrixXd pressure;   ///< (n_z, 2 n_x - 1) Pa, over the patch, both sides of the line
  Eigen::VectorXd line_load;  ///< (n_z) N/m
  double peak_pressure  = 0;  ///< Pa, Hertz pressure of the largest line load; theory.md 14 says why not of a node
  double half_width     = 0;  ///< m, Hertz half width there
  double nodal_pressure = 0;  ///< Pa, largest of `pressure`: what the mesh resolves
};

/// A solved roller.  Moment and tilt turn about mid-roller, positive when the side x > 0 of the line is closer.
struct RollerContactState {
  double approach         = 0;                        ///< m, of the two backs, at mid-roller
  double tilt             = 0;                        ///< rad, of the inner back against the outer
  double load             = 0;                        ///< N
  double moment           = 0;                        ///< N m, of the load about mid-roller
  Eigen::Matrix2d tangent = Eigen::Matrix2d::Zero();  ///< N/m, N, N m: d(load, moment)/d(approach, tilt), exact
  double roller_shift     = 0;                        ///< m, of the roller towards the outer raceway
  double roller_tilt      = 0;                        ///< rad, its own, free
  RollerSide inner, outer;
  int iterations  = 0;
  double residual = 0;  ///< -, largest violation of the contact conditions, relative
};

/// Both contacts of one roller, unilateral and without friction; the roller finds its own place between them.
/// Keeps its active set from one solve to the next.
class RollerContact {
public:
  /// @param drop  (x from mid-roller, m) -> m, profile of one contact; empty: none.  A value that is not finite is
  /// taken as
  /// a
  ///              millimetre: a node that never touches.
  explicit RollerContact(const CondensedRoller &roller, const std::function<double(double)> &drop = {});
  ~RollerContact();
  RollerContact(RollerContact &&) noexcept;

  /// At imposed approach (m) and tilt (rad) of the backs.  Nothing touching is a state: load 0.
  /// @throws SolverError  the contact reaches the edge of the meshed patch: largest_load is too small
  RollerContactState solve(double approach, double tilt = 0);
  /// At imposed load (N, > 0).
  RollerContactState solve_load(double load, double tilt = 0);
  const contact::Problem &problem() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::fem
