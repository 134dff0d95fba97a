#pragma once
#include "reduce/bearing/assembly.h"

// Life and static safety of a bearing whose rollers are solved.  theory.md 5.8
namespace mill::bearing {
/// Loads that stand for radial and axial load in the rating formulas, N.
struct EquivalentLoads {
  double dynamic;  ///< P, ISO 281, (5.32)
  double statics;  ///< P_0, ISO 76, (5.33)
};
/// @param radial, axial  N, on the bearing; their signs do not count
EquivalentLoads equivalent_loads(const RollerBearing &bearing, double radial, double axial);

/// Basic rating life, revolutions that 90 % reach: 1e6 (C/P)^(10/3), (5.34); infinite without load.
double basic_life(double dynamic_rating, double equivalent_load);

/// Life by slices from the solved load of every roller, ISO/TS 16281.
struct ReferenceLife {
  double life;               ///< revolutions that 90 % of all rows reach together, L10r; infinite without load
  double equivalent_load;    ///< N, P_ref: the load with which (5.34) gives this life
  Eigen::VectorXd row_life;  ///< (rows) revolutions, of each row alone
};
/// Factor of the slices near the ends of a roller, (5.36).  That of the standard belongs to its slice and reaches
/// 2.33 in the last one, however wide that is: a life has its limit only with thin slices.
enum class EndFactor {
  none,
  standard,    ///< of each slice as it is
  thin_slices  ///< mean over the slice of that of thin ones, in its power 9/2: the limit of many slices
};

/// The inner ring turns, the load stands still against the outer one.  (5.35) .. (5.37)
/// @param dynamic_rating  N, C of all rows
/// @param ends            how much more the slices near the ends are loaded
/// @throws InputError  roller or pitch diameter missing
ReferenceLife reference_life(const RollerBearing &bearing, const AssemblyState &state, double dynamic_rating,
                             EndFactor ends = EndFactor::standard);

/// Fatigue load limit C_u, N, of a roller bearing: C_0/8.2, less above a pitch diameter of 100 mm.  ISO 281,
/// (5.38)
double fatigue_load_limit(double static_rating, double pitch_diameter);

/// a_ISO of a radial roller bearing, ISO 281, (5.39): at least 0.1, at most 50.
/// @param viscosity_ratio  kappa, 0.1 .. 4; outside it the end is used
/// @param contamination    e_C, 0 .. 1
/// @param load_ratio       C_u over the equivalent load
double life_factor(double viscosity_ratio, double contamination, double load_ratio);

/// Static rating from a line contact: radial load, N, under which the heaviest of the rollers presses the inner
/// raceway with `pressure` (Pa), if it carries five times the mean.  Independent of ISO 76, which has the same 4
/// GPa behind it.
/// @throws InputError  roller or pitch diameter missing
double radial_load_of_pressure(const RollerBearing &bearing, double pressure);

/// Speed of the cage, 1/s, between a turning shaft and a standing outer ring: half of (1 - D_we cos(a)/D_pw).
double cage_speed(const RollerBearing &bearing, double shaft_speed);

/// Centrifugal force of one steel roller, N, m D_pw omega_c^2 / 2; 0 without a speed or the sizes of the roller.
double centrifugal_force(const RollerBearing &bearing, double shaft_speed);
}  // namespace mill::bearing
