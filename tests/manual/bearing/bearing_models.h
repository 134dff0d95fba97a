#pragma once
#include "core/model/case.h"
#include "reduce/bearing/assembly.h"
#include "tests/manual/check/verification.h"

// Bearings of the manual's cases.
namespace mill::verify {
/// 266.7 x 355.6 x 230.188 mm, 4 x 39 rollers of 21.5 x 33.4 mm, ISO law, no clearance, no crown.
/// @param cup_angle  deg
RollerBearing bearing_266(double cup_angle = 20);

/// HH926700, two rows back to back, 14 rollers each, full lever of tilt; preload 100 N.
bearing::BearingModel bearing_hh926700();

/// Rings, neck and chock by a smooth positive definite rule that takes a quarter off the tangent at 1 MN; rows and
/// harmonics coupled, the chock not round.
bearing::RingFlexibility synthetic_rings(int rows, int modes);

/// Cases of the assembled bearing, part of bearing_cases().
std::vector<Case> assembly_cases();

/// Cases of life, ratings and catalogue, part of bearing_cases().
std::vector<Case> life_cases();
}  // namespace mill::verify
