#pragma once
#include "core/base/errors.h"
#include "core/model/material.h"
#include <map>
#include <set>
#include <string>

namespace mill {
/// Frame, screw-down and chocks: masses already reduced to the moving point, stiffnesses of the whole stand.
struct Frame {
  double upper_post_mass = 0, upper_beam_mass = 0, upper_packing_mass = 0, piston_mass = 0;     ///< kg
  double cylinder_mass   = 0;                                                                   ///< kg, per side
  double balance_mass    = 0;                                                                   ///< kg, total
  double lower_post_mass = 0, lower_beam_mass = 0, load_cell_mass = 0, lower_packing_mass = 0;  ///< kg
  double upper_post_stiffness = 0, upper_beam_stiffness = 0, piston_stiffness = 0;              ///< N/m
  double upper_packing_stiffness = 0, oil_column_stiffness = 0, cylinder_body_stiffness = 0;    ///< N/m
  double upper_chock_stiffness = 0, lower_chock_stiffness = 0;                                  ///< N/m
  double lower_post_stiffness = 0, lower_beam_stiffness = 0, lower_packing_stiffness = 0;       ///< N/m
  double load_cell_stiffness = not_given;  ///< N/m, absent: rigid
  double chock_to_housing_stiffness =
      not_given;                     ///< N/m, Kx of each work roll, both sides together; absent: rigid
  double modulus       = not_given;  ///< N/m, of the whole stand with touching work rolls, measured
  double modulus_error = 0.03;       ///< -, relative, of that calibration
  std::set<std::string> closing;     ///< keys of the stiffnesses above that take what the modulus leaves for them
  Place modulus_place;               ///< of the key
  std::map<std::string, std::string>
      source;  ///< of estimated members by their keys: those of one source move together
  std::map<std::string, double> tolerance;  ///< -, relative, of the members above by their keys, as far as given
};

/// Screw-down of one side as drawn; each part that is given replaces a stiffness of the frame.
struct Screwdown {
  double screw_diameter       = not_given;  ///< m, of the core
  double screw_length         = not_given;  ///< m, free length
  double nut_outside_diameter = not_given;  ///< m
  double nut_height           = not_given;  ///< m
  double nut_modulus          = 110e9;      ///< Pa, bronze
  double piston_diameter      = not_given;  ///< m, of oil column and piston
  double piston_length        = not_given;  ///< m
  double stroke               = not_given;  ///< m, height of the oil column
  double oil_modulus          = 1.4e9;      ///< Pa
  double load_cell_diameter   = not_given;  ///< m
  double load_cell_bore       = 0;          ///< m
  double load_cell_height     = not_given;  ///< m
};
}  // namespace mill
