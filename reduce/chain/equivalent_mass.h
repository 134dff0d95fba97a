#pragma once
#include "core/model/frame.h"
#include "reduce/chain/roll_shapes.h"
#include "reduce/chain/spring_chain.h"
#include <functional>
#include <vector>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// A part of a roll with mass spread evenly along it.
struct MassSpan {
  double from            = 0;  ///< m
  double to              = 0;  ///< m
  double mass_per_length = 0;  ///< kg/m
};

/// A mass that moves as one.
struct PointMass {
  double mass         = 0;  ///< kg
  double displacement = 0;  ///< in the unit of the shape
};

/// Mass that has, moving with `reference`, the kinetic energy of all parts moving with their share of the shape,
/// (4.3).
/// @param shape      displacement at x; smooth inside each span
/// @param reference  displacement of the point the mass is put at, in the unit of the shape
/// Cost: 40 evaluations of the shape per span (Gauss-Legendre, exact to degree 79).
double equivalent_mass(const std::function<double(double)> &shape, const std::vector<MassSpan> &spans,
                       const std::vector<PointMass> &points, double reference);

/// M1 and M6, kg: parts already reduced to the moving point, added up, (4.13).
double upper_frame_mass(const Frame &frame);
double lower_frame_mass(const Frame &frame);

/// M2, kg: upper backup roll, its bearings and chocks, cylinders and balance gear, (4.14).  `bent` is the roll,
/// `u` the load path; u.roll_upper is the reference, so the choice mid or mean is made by the K_ZW that went into
/// it.
double upper_backup_mass(const FourHigh &stand, const BentBackupRoll &bent, const Flexibilities &u);

/// M5, kg: lower backup roll, bearings and chocks, (4.15).
double lower_backup_mass(const FourHigh &stand, const BentBackupRoll &bent, const Flexibilities &u);

/// f2 at x, m/N: displacement of the backup roll from the ground, (4.11).
double backup_shape(const BentBackupRoll &bent, double bearing_displacement, double x);

/// f1 at x, m/N: displacement of the work roll from the ground, (4.12).
/// @param backup_reference  m/N, displacement of the backup roll's reference point: u2
double work_shape(const BentWorkRoll &bent, const BentBackupRoll &backup, double backup_reference, double x);

/// M3 or M4, kg: work roll with bearings and chocks, reference mid-length, (4.16).
/// @param chock_mass  kg, per side
double work_roll_mass(const FourHigh &stand, const BentWorkRoll &bent, const BentBackupRoll &backup,
                      double backup_reference, double chock_mass);
}  // namespace mill::reduce
