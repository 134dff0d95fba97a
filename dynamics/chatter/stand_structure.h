#pragma once
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mill::dynamics {
/// The stand as the roll bite feels it, whatever its model:  M x'' + C x' + K x = b dF,  gap change = b . x.
/// n unknowns, m points that are looked at.  dF is the change of the rolling force, which acts on the same row
/// that measures the gap, so that the work of the force is that on the gap.  theory.md (25.1)
struct StandStructure {
  std::string name;                 ///< "six masses", "craig-bampton"
  Eigen::MatrixXd M, C, K;          ///< (n, n) kg, N s/m, N/m
  Eigen::VectorXd b;                ///< (n) -
  std::vector<std::string> labels;  ///< (m) "upper housing" or "upper frame", "upper backup roll", ...
  Eigen::MatrixXd point;            ///< (m, n) displacement of each point, positive away from the strip
  /// (n, n) kg, mass above and below the strip, for the kinetic energy of a stack; empty: not known
  std::array<Eigen::MatrixXd, 2> stack_mass{};
  Eigen::Index n() const
  {
    return b.size();
  }
};

/// Six masses of an asymmetric four-high.  Bodies from the top as in core/model/chatter.h, 0..2 positive up, 3..5
/// positive down, b = (0, 0, 1, 1, 0, 0).
/// @param mass       kg, m0..m5
/// @param stiffness  N/m, k0 ground-0, k1 0-1, k2 1-2, k4 3-4, k5 4-5, k6 5-ground
/// @param damping    N s/m, c0 0-1, c1 0-2, c2 1-2, c3 3-4, c4 3-5, c5 4-5
/// @throws InputError  a mass not positive, a stiffness or damping below zero
StandStructure six_mass_structure(const std::array<double, 6> &mass, const std::array<double, 6> &stiffness,
                                  const std::array<double, 6> &damping);

/// A chain of masses with its own damping, without the springs and dampers of the strip (build it with
/// force_meaning "measured").
StandStructure structure_of(const MillModel &chain);

/// A stand in its modes.  The modes left out count as rigid.
StandStructure structure_of(const ModalModel &modes);
}  // namespace mill::dynamics
