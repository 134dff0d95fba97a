#pragma once
#include "fem/body/section_body.h"
#include <Eigen/Core>

// Plane-strain bodies with large displacements.  theory.md 13
namespace mill::fem {
/// What "linear elastic" means once strains are large: each law has the Young's modulus and Poisson's
/// ratio of the material at the undeformed state.
enum class ElasticLaw {
  hencky,               ///< Kirchhoff stress linear in the logarithmic strain
  biot,                 ///< Biot stress linear in the stretch: what corotational codes call linear elastic
  st_venant_kirchhoff,  ///< second Piola-Kirchhoff stress linear in Green's strain; softens under compression
  neo_hooke             ///< mu (tr C - 3)/2 - mu ln J + lambda (ln J)^2 / 2; stiffens under compression
};

/// Second Piola-Kirchhoff stress and its derivative with respect to Green's strain, in the plane.
struct LargeStress {
  Eigen::Vector3d stress;   ///< Pa, xx, yy, xy
  Eigen::Matrix3d tangent;  ///< Pa, symmetric, of (E_xx, E_yy, 2 E_xy)
};
/// @param F  (2, 2) deformation gradient in the plane; none across it
/// @throws SolverError  det F <= 0
LargeStress large_stress(const Material &material, ElasticLaw law, const Eigen::Matrix2d &F);

/// Internal forces of a displaced body and their derivative.
struct LargeForces {
  Eigen::VectorXd force;    ///< (2N) N per m of thickness
  SymmetricSparse tangent;  ///< (2N, 2N) N/m per m of thickness, upper triangle; symmetric, not always definite
};
/// @param displacement  (2N) m, unknowns of SectionBody::stiffness()
/// @throws InputError   not a plane-strain body, sizes that do not fit
/// @throws SolverError  a cell is turned inside out
/// Cost: one assembly.
/// Source: J. Bonet, R. D. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008), chapters 6, 9
LargeForces large_forces(const SectionBody &body, const Material &material, ElasticLaw law,
                         const Eigen::VectorXd &displacement);
}  // namespace mill::fem
