#pragma once
#include "dynamics/response/mill_model.h"
#include "twin/calibration/reduced_stand.h"
#include "twin/calibration/unknown.h"
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

// The stand whose springs and damping ratios are fitted, and how its modes follow them.  theory.md 44
namespace mill::twin {
/// What the case says.
struct FittedStand {
  dynamics::MillModel chain;  ///< empty where there is a detailed stand
  Eigen::VectorXd damping;    ///< (n) -, ratio of critical of each mode
  std::optional<ReducedStand> detailed = std::nullopt;
};

/// (n) Hz, of the case.
Eigen::VectorXd mode_frequencies(const FittedStand &stand);
Eigen::Index number_of_places(const FittedStand &stand);
/// A spring that is not zero, by its name.
bool is_spring(const FittedStand &stand, const std::string &name);
/// A mass of the chain or of a part, by its name.
bool is_mass(const FittedStand &stand, const std::string &name);
/// Names of the springs and masses that an unknown moves: "K1/K7" gives K1 and K7.
std::vector<std::string> members_of(const std::string &unknown);
/// Does the unknown move springs alone?
bool moves_springs(const FittedStand &stand, const std::string &unknown);
/// Do both springs hold one mass, or one part?
bool share_a_part(const FittedStand &stand, const std::string &a, const std::string &b);

/// The stand at theta in its n modes, with what each of p unknowns changes there.
struct StandAt {
  Eigen::VectorXd frequency;  ///< (n) rad/s
  Eigen::VectorXd damping;    ///< (n) -
  Eigen::VectorXd force;      ///< (n) kg^-1/2, of the bite force; the gain is in it
  Eigen::MatrixXd shape;      ///< (places, n) kg^-1/2
  double delay = 0;           ///< s
  /// (p) (n, n) 1/s2, 1/s and -: the dynamic stiffness changes by stiffness + i w damper - w^2 mass, (43.3).  All
  /// are empty for the gain and the delay; mass is empty for what moves no mass.
  std::vector<Eigen::MatrixXd> stiffness, damper, mass;
  /// (n) Change of the dynamic stiffness by unknown p, applied to the modal motion x at w.
  Eigen::VectorXcd change(std::size_t p, const Eigen::VectorXcd &x, double w) const;
};

/// @throws InputError  an unknown that the stand does not have
StandAt stand_at(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta);

/// (n, p) d ln w_i / d theta_p: half of what the dynamic stiffness of the mode changes by at its own frequency.
/// (45.10)
Eigen::MatrixXd frequency_slopes(const StandAt &trial);
}  // namespace mill::twin
