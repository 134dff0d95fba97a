#pragma once
#include "core/model/material.h"
#include "core/model/mesh_file.h"

namespace mill {
/// One roller between a convex and a concave raceway, and how finely the three are meshed.  What is left at zero
/// where a default is named is filled in by completed().
struct RollerSetup {
  double diameter       = 0;  ///< m, mean; the taper is left out, theory.md 14
  double length         = 0;  ///< m, of the body
  double contact_length = 0;  ///< m, of the line that may touch, in the middle of the body; default: all of it
  double inner_radius   = 0;  ///< m, of the convex raceway; 0: flat
  double outer_radius   = 0;  ///< m, of the concave raceway; 0: flat
  double inner_depth    = 0;  ///< m, thickness of the cone: behind it the piece of raceway is held
  double outer_depth    = 0;  ///< m, of the cup
  double land           = 0;  ///< m, raceway beyond each end of the roller; default: half the roller's diameter
  Material material{206e9, 0.3, 7850};
  double largest_load = 0;  ///< N, on the roller: the contact stays inside the meshed patch up to here; at
                            ///< most what makes the half width 0.04 diameters, 4.5 GPa in steel
  double finest_load = 0;   ///< N, where the half width is resolved as asked; default: largest_load / 30,
                            ///< or less so that the half width is 0.006 diameters
  double elements_per_half_width = 1;  ///< -, quadratic elements across the contact
  double end_element             = 0;  ///< m, along the line at its ends; default: 0.006 contact_length
  double largest_element         = 0;  ///< m, along the line; default: 0.05 contact_length
};

/// With its defaults and limits.
/// @throws InputError  sizes that are missing or contradict each other
RollerSetup completed(RollerSetup setup);

/// The same twice as coarse everywhere: its answer tells how far the finer one is from the limit.
RollerSetup coarsened(RollerSetup setup);

/// Hertz half width, m, of the roller on a raceway under `line_load` (N/m); both of one material.
/// @param raceway_radius  m, > 0 convex, < 0 concave, 0 flat
double line_half_width(const RollerSetup &setup, double raceway_radius, double line_load);

/// An eighth of the roller (groups as a roll's), and quarters of the two pieces of raceway (patch, top, back,
/// side, end, symmetry.x, symmetry.z) whose patches have the roller's mesh lines.
struct RollerMeshes {
  MeshFile roller, inner, outer;
};

template <class Io, class R, if_record<R, RollerSetup> = 0> void each_member(Io &&io, R &record)
{
  auto &[diameter, length, contact_length, inner_radius, outer_radius, inner_depth, outer_depth, land, material,
         largest_load, finest_load, elements_per_half_width, end_element, largest_element] = record;
  io("diameter", diameter);
  io("length", length);
  io("contact_length", contact_length);
  io("inner_radius", inner_radius);
  io("outer_radius", outer_radius);
  io("inner_depth", inner_depth);
  io("outer_depth", outer_depth);
  io("land", land);
  io("material", material);
  io("largest_load", largest_load);
  io("finest_load", finest_load);
  io("elements_per_half_width", elements_per_half_width);
  io("end_element", end_element);
  io("largest_element", largest_element);
}
}  // namespace mill
