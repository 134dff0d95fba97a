#pragma once
#include "core/numerics/derivative.h"
#include "reduce/bite/slab/karman.h"

// The integrated theories on a given circle with given friction: what the iterations of karman.h are made of.
namespace mill::bite {
/// The directions are the first seven of Input: both thicknesses, both tensions, friction, flow stress, arc
/// radius.
using Slope = Dual<7>;

/// One bite on a circle, per unit width.  Values without their derivatives where they were not asked for.
struct CircularBite {
  Slope force;                      ///< N/m
  Slope torque;                     ///< N, of one roll
  Slope neutral_thickness;          ///< m
  Slope neutral_cosine = 1.0;       ///< -, of the neutral angle; one where angles are small
  Slope arc_length;                 ///< m, to the entry
  Slope entry_flow_stress;          ///< Pa
  Slope exit_flow_stress;           ///< Pa
  bool skids              = false;  ///< no neutral point: it is taken at the nearer end of the arc
  double neutral_share    = 0.35;   ///< -, coordinate of the neutral point over that of the entry
  double neutral_position = 0;      ///< m
  double sticking_length  = 0;      ///< m, with friction at its limit
  double peak_pressure    = 0;      ///< Pa
  double least_pressure   = 0;  ///< Pa, at the steps of the integration; negative: the rolls would have to pull
  double largest_shear    = 0;  ///< -, mu p over the shear yield stress
  int steps               = 0;  ///< of the integration, tried: its cost
  Eigen::VectorXd position;     ///< (n) m
  Eigen::VectorXd thickness;    ///< (n) m
  Eigen::VectorXd pressure;     ///< (n) Pa
  Eigen::VectorXd shear;        ///< (n) Pa
  Eigen::VectorXd slip;         ///< (n) -
};

/// Bite on a circle of the given radius.
/// @param theory   karman or orowan
/// @param mu       -, Coulomb's coefficient; not used where the friction is a factor
/// @param share    -, guess of CircularBite::neutral_share
/// Without a neutral point the branch that reaches through the whole arc is taken and `skids` is set: what
/// an iteration over the radius needs on its way.
CircularBite solve_on_circle(const RollBite &bite, Theory theory, double radius, double mu,
                             const KarmanOptions &options, double share = 0.35);

/// Says that the neutral point leaves the arc and which friction it would take. @throws InputError always
[[noreturn]] void refuse_skidding(const RollBite &bite, Theory theory, double radius, double mu,
                                  const KarmanOptions &options);

/// @throws InputError  thickness, tension or friction with which no theory of slices can begin
void check_slices(const RollBite &bite);
}  // namespace mill::bite
