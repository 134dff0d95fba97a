#pragma once
#include "core/model/dynamics_settings.h"
#include "core/records/component.h"
#include "reduce/chain/beam_shapes.h"
#include <Eigen/Core>
#include <functional>
#include <string>

namespace mill::reduce {
/// A displacement along a roll under a bite force of 1 N.
struct RollShape {
  Eigen::VectorXd x;      ///< (n) m, from mid-length
  Eigen::VectorXd value;  ///< (n) m/N
};

/// Value of a sampled shape at x (m): cubic through the stations, not across the barrel end.
double value_at(const RollShape &shape, double x, double kink);

/// Deflection of a roll's axis at x (m from mid-length, x >= 0) under 1 N, m/N.
using Deflection = std::function<double(double)>;

/// Backup roll under 1 N spread evenly over its barrel, counted from its bearings.  theory.md 4.2
struct BentBackupRoll {
  Deflection deflection;
  double half_barrel = 0;    ///< m
  double half_span   = 0;    ///< m, to the bearing centre
  double mid = 0, mean = 0;  ///< m/N, 1/K_ZW by mid-length (4.8a) and by the mean under the load (4.8b)
  std::string method;        ///< "stepped Timoshenko beam"
  BentBackupRoll() = default;
  BentBackupRoll(const SteppedBeam &beam);                           ///< (4.7), (4.8a)
  BentBackupRoll(const Component &solid, double half_bearing_span);  ///< (22.13)
  /// 1/K_ZW
  double flexibility(MassReference reference) const;
};

/// The same roll, `factor` times as flexible.
BentBackupRoll times(BentBackupRoll roll, double factor);

/// Work roll pressed by 1 N of strip against its contact line.  theory.md 4.3
struct BentWorkRoll {
  Deflection deflection;
  double half_strip = 0;  ///< m, where the load ends: the deflection has a kink in its fourth derivative there
  BentWorkRoll()    = default;
  BentWorkRoll(const FoundationShape &foundation);  ///< (4.9)
  /// (22.13a): the meshed roll on the same springs, ends and necks free.
  /// @param contact_stiffness  N/m, K3, spread evenly over the barrel
  BentWorkRoll(const Component &solid, double half_strip, double contact_stiffness);
};
}  // namespace mill::reduce
