#pragma once
#include "core/records/stand_model.h"
#include "dynamics/response/response_slopes.h"
#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

// A stand of beams or of component modes whose connections follow factors, in the modes of its case.
// theory.md 44.7
namespace mill::twin {
/// A spring, or a line of springs, of the stand as its modes see it.
struct ReducedSpring {
  std::string name;           ///< "K3", "Kzc upper work roll"
  Eigen::MatrixXd stiffness;  ///< (q, q) 1/s2, V' R' k R V
  std::set<int> parts;        ///< numbers of the parts that it holds
};

/// The mass of a part as the modes of the case see it.
struct ReducedMass {
  std::string name;      ///< "mass upper work roll"
  Eigen::MatrixXd mass;  ///< (q, q) -, V' M_part V
};

/// The bodies as they are, with a factor on each connection and on the mass of each part.
struct ReducedStand {
  Eigen::VectorXd frequency;  ///< (q) rad/s, of the case, ascending
  Eigen::MatrixXd point;      ///< (places, q) kg^-1/2, displacement of each place in each mode of the case
  Eigen::VectorXd force;      ///< (q) kg^-1/2, bite force on each
  std::vector<ReducedSpring> springs;
  std::vector<ReducedMass> masses;
  Eigen::Index kept = 0;  ///< n lowest modes that respond; those above them only carry changes of shape
};

/// @param frequency  (k) Hz, ascending, of all modes of the stand
/// @param shape      (unknowns, k) kg^-1/2, mass-normalised
/// @param highest    Hz, modes up to it respond, as those that a simulation drives; at most 64 modes are taken, of
///                   which the upper ones let the shapes change
ReducedStand reduced_stand(const StandModel &stand, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                           double highest);

/// Its n kept modes with factors on springs and masses, and what ln of each factor changes in them.  (44.15)
/// @param springs  (springs) -
/// @param masses   (masses) -
/// @param damping  (n) -, ratios of critical
/// Cost: eigenvalues of a q x q matrix, 2 ms for 64.
dynamics::SlopedStand sloped_stand(const ReducedStand &stand, const Eigen::VectorXd &springs,
                                   const Eigen::VectorXd &masses, const Eigen::VectorXd &damping);
}  // namespace mill::twin
