#pragma once
#include "core/base/parameter.h"
#include "fem/housing/housing.h"
#include "meshes/housing/housing.h"
#include "tests/manual/check/verification.h"

// The housings that the cases solve, and the longer of these cases.
namespace mill::verify {
using meshes::HousingMeshSize;

/// Housing of a 1400 mm four-high stand with backup rolls of 1450 mm; every dimension is assumed.
MillHousing demo_housing();
/// The same below and above its feet.
MillHousing mirrored(MillHousing housing);

fem::ElasticBody meshed(const MillHousing &housing, const HousingMeshSize &size);
fem::HousingStatics solved(const MillHousing &housing, const HousingMeshSize &size);

double upper_mass(const fem::HousingStatics &housing);  ///< kg, posts and beam, moving with the screw
double lower_mass(const fem::HousingStatics &housing);  ///< kg, moving with the seat

std::vector<Check> housing_component_checks();
std::vector<Check> screwdown_checks();
}  // namespace mill::verify
