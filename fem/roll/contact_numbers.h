#pragma once
#include "fem/roll/contact_answers.h"

// Numbers of one contact at one load with their error models: no text, no files.
namespace mill::fem {
/// Stiffness of a contact at one load.  theory.md 2.4, 3.2
struct StiffnessAtLoad {
  Compared tangent;           ///< N/m, rolls squeezed between mirrored contacts
  Compared secant;            ///< N/m
  Compared curvature;         ///< N/m2; value NaN where it is not a line contact or the curve is too rough
  Compared in_stand_tangent;  ///< N/m, held as in the stand
  Compared in_stand_secant;   ///< N/m
  double exact;               ///< N/m, tangent of the active set at this one load
  double middle_secant;       ///< N/m, of the section at mid-length, over the whole length
  bool open_at_middle;        ///< the rolls do not touch at mid-length
  reduce::LineContact hertz;  ///< the same rolls without ends
  reduce::SecantLaws laws;
  double hertz_curvature;  ///< N/m2, of the same
};

/// Each error is the largest of: the companion mesh with the safety of a pair of meshes, the active set of this
/// one load (tangents), the Fourier engine.
/// @param load  N, inside the curves
/// @throws InputError  the load is outside a curve
StiffnessAtLoad stiffness_at(const ContactPairs &pairs, const ContactCurves &curves, double load);

/// d2F/d(approach)2 (N/m2) of a line contact without ends: its tangent compliance falls by A/F per newton.
/// theory.md (3.5b)
double line_contact_curvature(const reduce::LineContact &hertz, double load);

/// The section at mid-length at one load, and the distribution along the barrel.
struct SectionAtLoad {
  Compared half_width;               ///< m
  Compared peak_pressure;            ///< Pa
  Compared approach;                 ///< m, of the axes, mean over the contact length
  BarrelProfile mirrored, in_stand;  ///< along the barrel, by way of holding the rolls
  contact::State coarse_state;       ///< of the companion mesh, whose rolls can show it as fields
  double line_load_spread;           ///< -, line_load_spread() of the engines, in the stand; NaN without a second
  reduce::LineContact hertz;
};

/// Half width and peak pressure are fitted apart, theory.md (1.4); their error is also at least what a parabola of
/// both misses of the line load.
/// @param load  N, that of SecondEngine::mirrored_at
SectionAtLoad section_at(const ContactPairs &pairs, const ContactCurves &curves, double load);

/// Largest difference of the line load between two engines over the largest of the second, where both are in
/// contact and not within nine half widths of where it ends: the pressure is singular at a sharp barrel end.
double line_load_spread(const BarrelProfile &first, const BarrelProfile &second);
}  // namespace mill::fem
