#pragma once
#include "fem/body/condensed_surface.h"
#include "fem/contact/friction.h"
#include "fem/contact/mortar.h"
#include "fem/contact/problem.h"
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace mill::fem {
/// A condensed body where it stands: its own coordinates X are at  x = turn X + shift.
struct PlacedBody {
  const CondensedSurface *body = nullptr;
  Eigen::MatrixXd turn;    ///< (d, d) orthogonal, a reflection too; empty: as it is
  Eigen::VectorXd shift;   ///< (d) m; empty: zero
  double flexibility = 1;  ///< -, factor on its flexibility: the same body of another modulus
};

/// Rigid motion per unit of a driven mode, in the common coordinates.
struct RigidMotion {
  Eigen::VectorXd translation;  ///< (d) m; empty: zero
  Eigen::VectorXd rotation;     ///< (1 in the plane, 3) rad; empty: zero
  Eigen::VectorXd about;        ///< (d) m, a point of the axis; empty: the origin
};

/// One driven mode of a pair: what a unit of its motion does, and what balances a unit of its resultant.  The
/// balancing loads matter for bodies held only against rigid motion; a body held by its supports needs none.
struct DrivenMode {
  RigidMotion slave, master;         ///< of the two frames, per unit motion
  LoadCase slave_push, master_push;  ///< per unit motion, in the body's own coordinates: a load factor, or a
                                     ///< motion of held unknowns that is not rigid
  LoadCase slave_load, master_load;  ///< per unit resultant, in the body's own coordinates
};

struct PairOptions {
  double reach = 0;  ///< m, see contact::CouplingOptions
  /// m, distance of the undeformed bodies along the common normal at a point of the slave, in the common
  /// coordinates: the true profile.  Empty: from the meshes.
  std::function<double(const Eigen::VectorXd &)> gap;
  LoadCase slave_load, master_load;  ///< that act all the time, whatever is driven
};

/// Two condensed bodies as one contact problem.  Nodal forces of a state belong to the multipliers of `coupling`:
/// pressure = nodal / coupling.weight.  theory.md 12
struct BodyPair {
  contact::Coupling coupling;
  contact::Problem problem;

  Eigen::VectorXd pressure(const Eigen::VectorXd &nodal) const;      ///< (n) Pa
  Eigen::VectorXd slave_forces(const Eigen::VectorXd &nodal) const;  ///< (n_slave) N, along the outward normals
  Eigen::VectorXd master_forces(const Eigen::VectorXd &nodal) const;
  Eigen::MatrixXd points() const;  ///< (n, d) m, centres of the multipliers on the slave
};

/// @throws InputError  surfaces that do not face each other, dimensions that do not fit
/// Cost: the coupling, and products of its sparse rows with the dense flexibilities.
BodyPair pair_bodies(const PlacedBody &slave, const PlacedBody &master, const std::vector<DrivenMode> &modes,
                     const PairOptions &options = {});
/// Against a rigid obstacle, whose shape is options.gap (empty: it fits).  Its motion is the `master` of a mode
/// with the direction in which it moves; the gap closes by its part along the slave's normal.
BodyPair pair_with_rigid(const PlacedBody &slave, const std::vector<DrivenMode> &modes,
                         const PairOptions &options = {});

/// Two bodies with Coulomb friction.  A multiplier has the slave's directions at its node: normal, then tangents;
/// its force acts on the slave against them and on the master along them.  theory.md 12
struct FrictionalBodies {
  contact::Coupling coupling;
  contact::FrictionProblem problem;
};

/// @param friction  -, coefficient, the same everywhere
/// @throws InputError  as pair_bodies; a body condensed without its tangents
/// A tangent held by a plane of symmetry neither slips nor carries: it keeps a spring of its own, so that the
/// operator stays definite, and no motion reaches it.
FrictionalBodies pair_with_friction(const PlacedBody &slave, const PlacedBody &master,
                                    const std::vector<DrivenMode> &modes, double friction,
                                    const PairOptions &options = {});
}  // namespace mill::fem
