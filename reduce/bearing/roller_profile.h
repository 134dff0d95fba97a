#pragma once
#include "core/model/roller_bearing.h"
#include <Eigen/Core>

namespace mill::bearing {
/// Drop of the ground profile of a roller from the straight line, at one contact.  theory.md 5.2, 5.6
/// @param x  (n) m, from mid-roller, inside the effective length
/// @return   (n) m, not negative but for a table
/// Profiles by bearing.profile:
///   none, iso (ISO/TS 16281 by the type of roller), crown (circle of drop crown_drop at the roller end),
///   log (Johns and Gohar), lundberg, both ground for the load profile_load on one roller; without it for 2 GPa on
///   the inner raceway;
///   three-parameter (Fujiwara and Kawase): profile_load, profile_share of the length crowned, crown_drop at the
///   end; table: linear between profile_table's points, mirrored when all its x are >= 0.
/// @throws InputError  profile unknown, or a dimension it needs missing; table unordered or shorter than the
/// roller Sources: G. Lundberg, Forschung 10 (1939) 201; P. M. Johns, R. Gohar, Tribology International 14 (1981)
/// 131; H. Fujiwara, T. Kawase, NTN Technical Review 75 (2007) 140.
Eigen::VectorXd profile_drop(const RollerBearing &bearing, const Eigen::VectorXd &x);

/// Radius of the roller against a raceway, m; the inner one is convex, the outer one concave.
double effective_radius(const RollerBearing &bearing, bool inner);
}  // namespace mill::bearing
