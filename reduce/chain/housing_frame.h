#pragma once
#include "core/model/housing.h"
#include <array>

namespace mill::reduce {
/// Parts of a frame of beams, divided at the feet and where the axes of beam and post meet.
enum FramePart { upper_post, upper_beam, lower_post, lower_beam, n_frame_parts };

/// What beam theory leaves open.
struct FrameChoice {
  /// Share of a corner (half the post's width along a beam, half the beam's height along a post) that does not
  /// bend: 0 beams as long as their axes, 1 only the window's sides bend.
  double rigid_corner = 0.5;  ///< -
};

/// Both housings of a stand as closed frames of beams under a unit bite force: what fem::HousingStatics is by
/// finite elements.  theory.md 23.4
struct HousingFrame {
  double u_screw   = 0;                               ///< m/N, mean of the beam's axis over the pad, from the feet
  double u_seat    = 0;                               ///< m/N, negative
  double exchanged = 0;                               ///< m/N, as there
  std::array<double, n_frame_parts> energy{};         ///< m/N, twice the strain energy under 1 N
  std::array<double, n_frame_parts> flexibility{};    ///< m/N
  std::array<double, n_frame_parts> reduced_mass{};   ///< kg
  std::array<double, n_frame_parts> vertical_mass{};  ///< kg, of that what moves up and down
  std::array<double, n_frame_parts> mass{};           ///< kg
  double fixity = 0;  ///< -, bending moment at the upper joint over that of a beam built in, axis to axis
};

/// Posts in tension, bending and shear, beams in bending, shear and tension; Timoshenko beams with Cowper's shear
/// factor for a rectangle, exact for loads spread evenly over the pads.  Fillets are left out.
/// @throws InputError  a dimension not positive, feet outside the posts, a choice outside 0..1
/// Cost: a system of 16 unknowns.
HousingFrame housing_frame(const MillHousing &housing, const FrameChoice &choice = {});

/// Reduced masses by rule: a third of a post, 17/35 of a beam on two posts (central load).  kg, both housings.
std::array<double, n_frame_parts> masses_by_rule(const MillHousing &housing);
}  // namespace mill::reduce
