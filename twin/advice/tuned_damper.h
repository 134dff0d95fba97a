#pragma once
#include "twin/advice/joined_stand.h"
#include <Eigen/Core>
#include <array>

// A mass on a spring and a damper, tuned so that the level of a place is least.  theory.md 46.4
namespace mill::twin {
/// One tuned damper and what it does to the level of one place.
struct TunedDamper {
  int mode              = 0;   ///< of the stand, whose share of the level is largest and for which it is made
  double effective_mass = 0;   ///< kg, of that mode at the place of the damper
  Attachment start;            ///< by the closed forms for white force (46.7)
  Attachment best;             ///< of the least level
  double start_change = 0;     ///< -, relative change of the level
  double change       = 0;     ///< -
  bool inside         = true;  ///< the least level lies inside the range that was searched
  /// Frequency of the damper off by this, and the change that is left; -0.05 and 0.05 are among them.
  Eigen::VectorXd detuning;            ///< (d) -
  Eigen::VectorXd detuned_change;      ///< (d) -
  double detuned_by(double by) const;  ///< -, change at one of the detunings
};

/// The mode of a stand with the largest share of the mean square of a place.
/// @param at  the mode also moves this place by more than a thousandth of what its mass allows
int leading_mode(const VibratingStand &stand, int seen, int place, const ForceBand &force);

/// kg: 1/phi^2 of a mode at a place; infinite at a node.
double effective_mass(const VibratingStand &stand, int mode, int place);

/// (46.7): the tuning that is best for one undamped mode under white force.
/// @param ratio  -, mass over the effective mass of the mode
Attachment closed_tuning(const VibratingStand &stand, int mode, int place, double ratio);

/// Starts from `start` and minimises the level of `seen` over frequency and damping of the mass, all else held.
/// @param joined  what else is joined to the stand
/// @param level   m/s2, with nothing but `joined`: what changes are relative to
/// Cost: some 100 evaluations of k frequencies, 2 ms each for 50 000.
TunedDamper tune(const VibratingStand &stand, const std::vector<Attachment> &joined, int seen,
                 const Attachment &start, const ForceBand &force, double level);
}  // namespace mill::twin
