#pragma once
#include "core/model/strip.h"
#include "core/records/strip_lines.h"

namespace mill::meshes {
/// Sizes of the mesh of half a strip between its rolls: one block of quadrilaterals from the inlet to the outlet,
/// x towards the inlet, x = 0 on the line of centres, y from the mid plane.  Elements along the arc are finest
/// where contact begins and ends and at the neutral point, and grow from there; inlet and outlet go on with the
/// sizes of the ends of the arc.
struct StripBlock {
  double entry_thickness = 0;     ///< m
  double exit_thickness  = 0;     ///< m
  double arc_length      = 0;     ///< m, line of centres to the entry
  double outside         = 0;     ///< m, length of inlet and of outlet
  double neutral         = 0.3;   ///< -, neutral point over the arc, from the line of centres
  double finest          = 0.25;  ///< -, smallest element along the arc over the largest
  int along   = 48;  ///< elements on the arc, a multiple of 4; inlet and outlet have a quarter of them each
  int through = 12;  ///< elements through half the thickness
};

/// Sizes for a pass: outside one entry thickness long, 1.5 for strip thicker than half the arc; neutral point
/// where constant friction and flow stress put it on a flat arc.
StripBlock strip_block(const Strip &strip, double roll_radius, int along = 48, int through = 12);

/// The lines of the mesh; the solver places its spines on them itself.
/// @throws InputError  numbers or lengths that make no mesh
StripLines strip_lines(const StripBlock &block);
}  // namespace mill::meshes
