#pragma once
#include "dynamics/response/mill_model.h"
#include "twin/calibration/reduced_stand.h"
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// The stand whose springs and damping ratios are fitted, and how its modes follow them.  theory.md 44
namespace mill::twin {
/// A number that is fitted: theta = ln of a factor on what the case says; of the delay seconds.
struct Unknown {
  /// "K3"    a spring of the chain that is not zero, or a connection of a detailed stand
  /// "zeta"  the damping ratios of all modes by one factor; "zeta2" that of the second mode
  /// "f2"    the frequency of the second mode alone, its shape and ratio kept; not beside springs
  /// "gain"  all accelerations by one factor
  /// "delay" s, by which the accelerations are later than the force (two clocks)
  std::string name;
  double prior_sd = std::numeric_limits<double>::infinity();  ///< standard deviation of theta before the record
  double prior    = 0;                                        ///< theta before the record
};

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
/// Do both springs hold one mass, or one part?
bool share_a_part(const FittedStand &stand, const std::string &a, const std::string &b);

/// The stand at theta in its n modes, with what each of p unknowns changes there.
struct StandAt {
  Eigen::VectorXd frequency;  ///< (n) rad/s
  Eigen::VectorXd damping;    ///< (n) -
  Eigen::VectorXd force;      ///< (n) kg^-1/2, of the bite force; the gain is in it
  Eigen::MatrixXd shape;      ///< (places, n) kg^-1/2
  double delay = 0;           ///< s
  /// (p) (n, n) 1/s2 and 1/s: the dynamic stiffness changes by stiffness + i w damper, (43.3); both empty for the
  /// gain and the delay.
  std::vector<Eigen::MatrixXd> stiffness, damper;
};

/// @throws InputError  an unknown that the stand does not have
StandAt stand_at(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta);
}  // namespace mill::twin
