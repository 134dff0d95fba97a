#pragma once
#include "core/progress.h"
#include "core/records.h"
#include "fem/condensed_roll.h"
#include "fem/contact_solver.h"
#include <string>
#include <vector>

namespace mill::fem {
/// Two condensed rolls facing each other along one contact line.
struct ContactPair {
  std::string name;                     ///< "upper", "lower", "line"
  std::string reference;                ///< datum of the approach, one sentence
  const CondensedRoll *grid = nullptr;  ///< either roll: stations of the patch and of the axis
  ContactProblem problem;
  Eigen::MatrixXd axis;          ///< (n_a, n) m/N, sum of both: axes moving away from the contact
  Eigen::VectorXd axis_support;  ///< (n_a) m/N
  Eigen::VectorXd mean;          ///< (n_a) -, weights of the mean over the contact length, sum 1
  double multiplicity = 4;       ///< total force over the sum of nodal forces; slabs: per metre, 2 / thickness
  double axial_mirror = 2;       ///< -, line load over (force per station / axial weight): both sides of x = 0
};

/// Distance of the two undeformed surfaces at (x, z), from the analytic profiles and never from facets: radii and
/// the drops of the two profiles (m on the radius, positive: smaller roll), shifted so that the smallest is zero.
Eigen::VectorXd profile_gap(const CondensedRoll &grid, double first_radius, double second_radius,
                            const Eigen::VectorXd &drop);

/// Puts a pair together.  The rolls must share their patch grid.  For two slabs every load is per metre of length.
/// @param drop (n_z) m, sum of the two profiles' drops at the stations
ContactPair make_pair(const std::string &name, const CondensedRoll &first, const HeldRoll &first_held,
                      const CondensedRoll &second, const HeldRoll &second_held, const Eigen::VectorXd &drop);

/// One solved load.
struct ContactPoint {
  ContactState state;
  double load;      ///< N, total
  double approach;  ///< m, axis to axis, mean over the contact length
  double tangent;   ///< N/m, exact dF/d(approach)
};
ContactPoint solve_load(const ContactPair &pair, double load, const std::vector<char> &start = {});

/// Load-approach curve; each load starts from the active set of the one before.
/// @throws SolverError  names the load and how many steps are good
ContactCurve sweep(const ContactPair &pair, const Eigen::VectorXd &loads, const Progress &progress = {});

/// Distribution along the contact line at one load.
BarrelProfile barrel_profile(const ContactPair &pair, const ContactPoint &point);

/// n loads from low to high, equally spaced in their logarithm.
Eigen::VectorXd log_spaced(double low, double high, int n);
}  // namespace mill::fem
