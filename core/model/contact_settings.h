#pragma once
#include "core/base/errors.h"
#include "core/model/material.h"
#include <array>

namespace mill {
/// How one contact line is solved.
struct ContactSettings {
  std::array<double, 2> loads = {not_given, not_given};  ///< N (four-high), N/m (two-cylinders): swept range
  int samples                 = 24;                      ///< loads in the sweep, logarithmically spaced
  int elements_per_half_width = 8;          ///< quadratic elements per Hertz half width of the largest load
  double length               = not_given;  ///< m, two-cylinders: plane strain over this length
  double at                   = not_given;  ///< N/m, two-cylinders: load of the scalar results
  double tilt                 = not_given;  ///< rad, of the axes in the plane of the load, closing at z > 0
  double load_offset          = not_given;  ///< m, of the resultant from mid-length
  double cross_angle          = 0;          ///< rad, of the axes in the plane of contact
  double axis_offset          = 0;          ///< m, across the plane of the load
  double friction             = not_given;  ///< -, Coulomb; absent: frictionless
  double path_trim            = 0.1;        ///< -, share of the path left out at each end for the plateau
  Place loads_place, elements_place;        ///< for messages
};

// The two places are for messages.
template <class Io> void each_member(Io &&io, const ContactSettings &record)
{
  const auto &[loads, samples, elements_per_half_width, length, at, tilt, load_offset, cross_angle, axis_offset,
               friction, path_trim, loads_place, elements_place] = record;
  io("loads", loads);
  io("samples", samples);
  io("elements_per_half_width", elements_per_half_width);
  io("length", length);
  io("at", at);
  io("tilt", tilt);
  io("load_offset", load_offset);
  io("cross_angle", cross_angle);
  io("axis_offset", axis_offset);
  io("friction", friction);
  io("path_trim", path_trim);
}
}  // namespace mill
