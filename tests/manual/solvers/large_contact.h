#pragma once
#include "tests/manual/solvers/large_section.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// Two plane-strain bodies pressed together with large displacements.  theory.md 13
namespace mill::fem {
/// A body, how it is held, and where it stands.
struct LargeBody {
  const SectionBody *body = nullptr;
  Material material;
  std::vector<char> held;  ///< (unknowns) 1: held at zero
  std::string patch;       ///< group that may touch
  Eigen::VectorXd load;    ///< (unknowns) per unit of the pressing force, dead; empty: the supports carry it
  Eigen::Matrix2d turn  = Eigen::Matrix2d::Identity();  ///< x = turn X + shift, orthogonal
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();      ///< m
};

struct LargeContact {
  Eigen::VectorXd slave, master;  ///< (unknowns) m, displacements in each body's own coordinates
  double descent = 0;             ///< m, rigid motion of the master along -y
  Eigen::MatrixXd points;         ///< (n, 2) m, where the multipliers act, on the deformed slave
  Eigen::VectorXd pressure;       ///< (n) Pa, on the deformed surface (Cauchy)
  Eigen::VectorXd nodal;          ///< (n) N/m
  int iterations    = 0;          ///< Newton steps
  double correction = 0;          ///< -, largest displacement of the last step / largest displacement
  double unbalanced = 0;          ///< -, largest nodal force out of balance / pressing force
  double residual   = 0;          ///< -, of the conditions of contact in the last step
};

/// Newton on the displacements of both bodies.  Each step condenses both tangent stiffnesses onto the deformed
/// surfaces, couples these where they are, and solves the linearised contact exactly.  Left out of the tangent is
/// how normals turn with the step: convergence is linear, with a ratio of the size of the slopes in the contact.
/// The first step is the solution for small displacements.
/// @param force  N per m of thickness, that of the master on the slave along -y
/// @throws SolverError  no convergence within 40 steps
/// Cost: two assemblies, two factorisations and a dense contact per step.
LargeContact press_together(const LargeBody &slave, const LargeBody &master, ElasticLaw law, double force);
}  // namespace mill::fem
