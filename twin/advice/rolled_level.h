#pragma once
#include "core/model/process_advice.h"
#include "twin/advice/changed_stand.h"
#include "twin/advice/critical_state.h"
#include "twin/advice/process_action.h"
#include "twin/chatter/critical_track.h"
#include <Eigen/Core>
#include <limits>
#include <vector>

// The level of a stand that rolls a pass, and its critical speed.  theory.md 46.8
namespace mill::twin {
/// The pass of a stand whose level is asked.
struct RolledPass {
  ChatterModel model;            ///< its structure and its numbers are not read
  double working_speed = 0;      ///< m/s
  ProcessAdvice process;         ///< what is tried with the pass, and what it must keep
  double nearer_chatter = 0.01;  ///< -, most that critical over working speed may fall
  bool disturbance = false;  ///< the force of the level is the disturbance itself, without the answer of the bite
};

/// A pass after an action.
struct RolledState {
  CriticalState critical;
  Violations violated;
  double nearer = std::numeric_limits<double>::quiet_NaN();  ///< -, change of critical over working speed
  Eigen::VectorXd level;  ///< (m) m/s2, of every place; empty: not asked, or none since vibration grows
};

/// A stand, its pass and the force that its level belongs to.
class RolledLevel {
public:
  /// @param open   kept by value; it gives the stand as it is for a change of nothing
  /// @param force  of the level, kept by reference
  RolledLevel(const RolledPass &pass, OpenStand open, const ForceBand &force);

  /// As it is.
  const CriticalState &now() const;
  /// There is a steady bite and vibration decays: process actions have a level.
  bool settled() const;

  /// (m) m/s2, of every place with the bite in the loop; empty unless settled.  Where the force is that of the
  /// whole bite, the level of the stand without it.
  const Eigen::VectorXd &level() const;

  /// After an action.  The level follows where the process changes: the disturbance that makes the force as it is
  /// stays, the bite responds to it again, contacts follow the rolling force.  (46.14)
  /// @returns nothing where `open` has no such stand
  /// Cost: a search of the critical speed, 10 ms with six masses and 0.3 s with thirty modes; with a process
  /// action as much as levels() more.
  std::optional<RolledState> after(StandChange change, const std::vector<Attachment> &joined,
                                   const std::vector<ProcessAction> &process) const;

  /// (m) d ln level/d ln of what a process action changes, by central differences; empty where a neighbour has no
  /// bite.
  Eigen::VectorXd slope(ProcessAction action) const;

private:
  const RolledPass pass_;
  const OpenStand open_;
  const ForceBand &force_;
  CriticalState now_;
  Eigen::VectorXd level_;
  Eigen::VectorXd weight_;  // (k) m2/s4 N2/N2: mean square of the disturbance, times w^4

  Eigen::VectorXd level_of(const VibratingStand &open, const std::vector<Attachment> &joined,
                           const dynamics::WorkingPoint &point) const;
  dynamics::ChatterStandModel around(const VibratingStand &open, const std::vector<Attachment> &joined) const;
};
}  // namespace mill::twin
