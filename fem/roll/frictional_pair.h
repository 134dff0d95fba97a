#pragma once
#include "fem/contact/friction.h"
#include "fem/roll/contact_study.h"

namespace mill::fem {
/// Contact of two rolls with Coulomb friction: a quarter of both, squeezed between mirrored contacts, condensed
/// with their tangential components (CondenseOptions::tractions).
struct FrictionPoint {
  double load;      ///< N, total
  double approach;  ///< m, axis to axis
  double tangent;   ///< N/m, exact for the status of all nodes, further loading
  double slipping;  ///< -, share of the touching nodes that slip
  double traction;  ///< -, largest tangential over friction-limited force, 1 where a node slips
  double residual;  ///< -
};

/// Loads from zero to `load` in equal steps.  The path matters: stick remembers where a node first touched.
/// @param pair  the same two rolls without friction, a quarter, mirrored
/// @throws SolverError  as contact::FrictionSolver
/// Cost: some LU factorisations of three times the touching nodes per step.
FrictionPoint load_with_friction(const ContactPair &pair, const CondensedRoll &first, const CondensedRoll &second,
                                 double friction, double load, int steps);

/// What friction does to the tangent: with friction over without, both on the mesh of this pair.
/// @param steps  equal load steps from zero
struct FrictionEffect {
  double ratio;     ///< -, tangent with friction over tangent without
  double slipping;  ///< -, share of the touching nodes that slip
};
FrictionEffect friction_effect(const ContactPair &pair, const CondensedRoll &first, const CondensedRoll &second,
                               double friction, double load, int steps);
}  // namespace mill::fem
