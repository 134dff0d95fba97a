#pragma once
#include "fem/body/elastic_body.h"
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

// Elastoplastic solids of small strain, pressed by a rigid obstacle.  theory.md 13
namespace mill::fem {
/// Deformation theory (Hencky): stress is a function of the present strain alone, the law of a load that only
/// grows.  With s = 2 mu |dev strain|, the norm of the elastic deviator (Frobenius, not von Mises):
///     dev stress / dev elastic stress = 1                                  s <= yield
///                                       hardening + (1 - hardening) yield/s   otherwise
struct PlasticLaw {
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio  = 0;  ///< -
  double yield     = 0;  ///< Pa, norm of the stress deviator where plastic flow begins: tensile yield sqrt(2/3)
  double hardening = 0;  ///< -, slope of |dev stress| over s beyond yield, 0 (none) to 1 (elastic)
};

/// Strains and stresses in the order xx, yy, zz, xy, yz, zx, shears as engineering strains.
struct PlasticStress {
  Eigen::Matrix<double, 6, 1> stress;   ///< Pa
  Eigen::Matrix<double, 6, 6> tangent;  ///< Pa, symmetric, positive definite for hardening > 0
  double energy;                        ///< J/m3, whose derivatives these are
};
PlasticStress plastic_stress(const PlasticLaw &law, const Eigen::Matrix<double, 6, 1> &strain);

/// A body and the rigid obstacle that stands over its surface.
struct PressedSolid {
  const ElasticBody *body = nullptr;  ///< mesh and shape functions; its own material is not used
  PlasticLaw law;
  std::vector<char> held;     ///< (unknowns) 1: held at zero
  std::string patch;          ///< group that may touch
  Eigen::Vector3d direction;  ///< -, outward: nodes are pressed along it
  /// m, height of the obstacle over a node of the undeformed patch along the direction; negative: it must yield
  std::function<double(const Eigen::Vector3d &)> gap;
};

struct PressedState {
  Eigen::VectorXd displacement;  ///< (unknowns) m
  double force = 0;              ///< N, of the obstacle on the body
  Eigen::VectorXd nodal;         ///< (n) N, on the nodes of the patch
  int n_touching    = 0;
  int n_unknowns    = 0;  ///< free ones
  int iterations    = 0;  ///< Newton steps
  double unbalanced = 0;  ///< -, largest force out of balance on a node that does not touch / force
  double residual   = 0;  ///< -, of the conditions of contact in the last step
  double plastic    = 0;  ///< -, share of the quadrature points that yield
};

/// Semismooth Newton.  Each step condenses the tangent stiffness onto the patch and solves the linearised contact
/// with its exact active set.  The solution minimises a convex energy over a convex set, so that a step which is
/// halved until the energy falls converges from anywhere.
/// @throws InputError   hardening that is not positive, sizes that do not fit
/// @throws SolverError  no convergence within 60 steps
/// Cost: one assembly, one factorisation and a dense contact per step.
/// Source: the law and its tangent: J. Frohne, T. Heister, W. Bangerth, Int. J. Numer. Meth. Eng. 105 (2016) 416
PressedState press_plastic(const PressedSolid &solid);
}  // namespace mill::fem
