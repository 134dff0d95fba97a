#pragma once
#include "core/base/each_member.h"
#include "core/model/material.h"
#include "core/model/mesh_file.h"
#include "reduce/bite/bite.h"
#include <Eigen/Core>

namespace mill::fem {
/// Section of a solid work roll that the strip presses on.
struct BiteRoll {
  double radius = 0;  ///< m
  Material material;
  double arc = 0;                ///< m, sqrt(R dh); scales the error estimate only
  Eigen::VectorXd position;      ///< (n) m, rising, symmetric, n odd: points of the pressure, meshes::arc_points
  double backup_half_width = 0;  ///< m, of the contact with the back-up roll opposite to the strip, an ellipse of
                                 ///< pressure; 0: no such roll, the necks carry: a force spread over the section
  bool with_shear = false;       ///< also what friction on the arc does to the shape
};

/// @throws InputError   an even number of points or fewer than three, points that do not rise or are not
///                      symmetric, a back-up contact wider than half the radius
void require_roll(const BiteRoll &roll);

struct BiteRollResult {
  bite::ArcFlexibility flexibility;
  /// (n, n) m/Pa: displacement towards the axis at i by unit friction stress at j, on the strip towards the exit
  /// (bite::BiteState::shear), so on the roll towards the entry; empty unless asked for
  Eigen::MatrixXd shear_influence;
  double error_estimate = 0;  ///< -, arc_difference() of two meshes; 0 without a second one
  int n_unknowns        = 0;  ///< per symmetry case
};

template <class Io, class R, if_record<R, BiteRollResult> = 0> void each_member(Io &&io, R &record)
{
  auto &[flexibility, shear_influence, error_estimate, n_unknowns] = record;
  io("flexibility", flexibility);
  io("shear_influence", shear_influence);
  io("error_estimate", error_estimate);
  io("n_unknowns", n_unknowns);
}

/// How far the surface of a work roll deflects in the bite, from its whole section in plane strain.  theory.md 20
/// Quarter of the section, once for each of the four parities; both directions of the load follow from them.
///
/// Pressure and displacement are radial: a rotation of the roll then neither is excited nor changes its shape.
/// Displacements are measured from the centre of the section, where the axis is.  What the pressure leaves
/// unbalanced is carried by the back-up roll (vertical) and by forces spread over the section (horizontal, and the
/// moment of the friction): in the roll they come from the neighbouring sections.
///
/// @param mesh    meshes::mesh_bite_roll of the same radius
/// @param coarse  a coarser one for the error estimate; null: none
/// @throws InputError   as require_roll()
/// @throws SolverError  the stiffness is not positive definite
/// Cost: four factorisations of some 10^4 unknowns and (n + 1)/2 solutions each: below one second.
BiteRollResult bite_roll_flexibility(const BiteRoll &roll, const MeshFile &mesh, const MeshFile *coarse = nullptr);

/// Largest difference between two flexibilities in the shape of the arc, u(x) - u(0) between -0.3 and 1.2 arc,
/// under a parabolic hill of pressure from 0 to arc; relative to the largest |u(x) - u(0)| there.
/// @throws InputError  points that are not the same
double arc_difference(const bite::ArcFlexibility &a, const bite::ArcFlexibility &b, double arc);
}  // namespace mill::fem
