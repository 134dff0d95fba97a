#pragma once
#include "core/model/material.h"
#include <cmath>

namespace mill {
/// Mill housing of one side, a closed window frame of one thickness; the other side is the same.  x along the pass
/// line, y up, z along the rolls.  Absent when thickness is not given.
struct MillHousing {
  double thickness         = not_given;  ///< m, along the rolls
  double post_width        = 0;          ///< m, along the pass line
  double window_width      = 0;          ///< m, between the posts
  double window_height     = 0;          ///< m, between the beams
  double upper_beam_height = 0;          ///< m
  double lower_beam_height = 0;          ///< m
  double fillet_radius     = 0;          ///< m, of the corners of the window
  double foot_height       = 0;  ///< m, from the window's bottom up to where the posts stand on the foundation
  double screw_pad         = 0;  ///< m, side of the square that the nut presses on, under the upper beam
  double seat_pad          = 0;  ///< m, side of the square that the lower chock presses on, on the lower beam
  double modulus           = not_given;  ///< Pa, as given; absent: that of the rolls
  double density           = not_given;  ///< kg/m3, the same
  Material steel;                        ///< complete
  double stiffness = not_given;          ///< N/m, of one housing between screw and seat, known without a drawing
  bool present() const
  {
    return !std::isnan(thickness);
  }
};

// Modulus and density as given are in `steel`, completed; a stiffness stands in place of a drawing.
template <class Io> void each_member(Io &&io, const MillHousing &record)
{
  const auto &[thickness, post_width, window_width, window_height, upper_beam_height, lower_beam_height,
               fillet_radius, foot_height, screw_pad, seat_pad, modulus, density, steel, stiffness] = record;
  io("thickness", thickness);
  io("post_width", post_width);
  io("window_width", window_width);
  io("window_height", window_height);
  io("upper_beam_height", upper_beam_height);
  io("lower_beam_height", lower_beam_height);
  io("fillet_radius", fillet_radius);
  io("foot_height", foot_height);
  io("screw_pad", screw_pad);
  io("seat_pad", seat_pad);
  io("steel", steel);
}
}  // namespace mill
