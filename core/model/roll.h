#pragma once
#include "core/base/choice.h"
#include "core/model/material.h"
#include "core/model/roll_geometry.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
/// Source of K_ZW and of the shapes of the chain.
enum class BendingModel { solid, beam };
constexpr auto words_of(BendingModel)
{
  return choice_words<BendingModel>("solid", "beam");
}

/// A roll as drawn.  Work roll and backup roll are the same struct; the case file names their lengths differently.
struct Roll {
  double barrel_diameter = 0;  ///< m, ground diameter of the barrel
  double barrel_length   = 0;  ///< m
  double neck_diameter   = 0;  ///< m
  double neck_length     = 0;  ///< m, each side, from the barrel end to the end of the roll
  double bearing_span    = 0;  ///< m, between the centres of the two bearings
  double crown           = 0;  ///< m, diameter at mid-length minus diameter at the barrel end (parabola)
  std::vector<std::array<double, 2>> crown_table;  ///< m, (z, diameter difference to the nominal); replaces crown
  std::vector<std::array<double, 2>> crown_polynomial;  ///< (power -, m on the diameter), in 2 z / barrel_length
  double thermal_crown = 0;                             ///< m, on the diameter, as crown
  std::vector<std::array<double, 2>> thermal_crown_table;  ///< m, as crown_table
  double end_chamfer_length           = 0;                 ///< m
  double end_chamfer_depth            = 0;                 ///< m, on the radius
  double axial_shift                  = 0;                 ///< m, upper work roll towards z > 0
  std::array<double, 2> bending_force = {0, 0};  ///< N, chocks at z > 0 and z < 0, towards the backup roll
  BendingModel bending_model          = BendingModel::solid;  ///< of the backup roll
  std::string bearing;                                        ///< name of a [bearing.*]
  double bearing_mass     = 0;                                ///< kg, per side
  double chock_mass_upper = 0;                                ///< kg, per side, in the upper half of the stand
  double chock_mass_lower = 0;                                ///< kg, per side, in the lower half
  double bearing_load =
      not_given;  ///< N, radial load of one bearing; absent: F/2 (backup), F/20 assumed (work roll)
};

// A roll as its contact sees it: the parts on its necks and the bending model of the chain do not belong to it.
template <class Io> void each_member(Io &&io, const Roll &record)
{
  const auto &[barrel_diameter, barrel_length, neck_diameter, neck_length, bearing_span, crown, crown_table,
               crown_polynomial, thermal_crown, thermal_crown_table, end_chamfer_length, end_chamfer_depth,
               axial_shift, bending_force, bending_model, bearing, bearing_mass, chock_mass_upper,
               chock_mass_lower, bearing_load] = record;
  io("barrel_diameter", barrel_diameter);
  io("barrel_length", barrel_length);
  io("neck_diameter", neck_diameter);
  io("neck_length", neck_length);
  io("bearing_span", bearing_span);
  io("crown", crown);
  io("crown_table", crown_table);
  io("crown_polynomial", crown_polynomial);
  io("thermal_crown", thermal_crown);
  io("thermal_crown_table", thermal_crown_table);
  io("end_chamfer_length", end_chamfer_length);
  io("end_chamfer_depth", end_chamfer_depth);
  io("axial_shift", axial_shift);
  io("bending_force", bending_force);
}

// Everything that is computed of a roll takes its shape from these three.

inline RoundSection barrel_section(const Roll &roll)
{
  return {roll.barrel_diameter};
}

inline RoundSection neck_section(const Roll &roll)
{
  return {roll.neck_diameter};
}

/// The solid of an eighth of it.
/// @param contact_half_length  m, part of the barrel that may touch; 0: all of it
inline RollGeometry roll_geometry(const Roll &roll, const double contact_half_length = 0)
{
  RollGeometry g;
  g.radius              = 0.5 * roll.barrel_diameter;
  g.half_length         = 0.5 * roll.barrel_length;
  g.neck_radius         = 0.5 * roll.neck_diameter;
  g.neck_length         = roll.neck_length;
  g.seat_centre         = 0.5 * roll.bearing_span;
  g.contact_half_length = contact_half_length;
  return g;
}
}  // namespace mill
