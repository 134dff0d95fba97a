#pragma once
#include "tests/manual/check/verification.h"
#include <vector>

// Cases of one roll at rest or on rigid seats against beam theory.
namespace mill::verify {
struct RollPart;
/// N/m, whole roll: even load on the barrel over the mean deflection of the section at mid-length, the seats' mean
/// at rest.
double solid_bending_stiffness(const RollPart &roll);
/// Hz, first frequency with the seats' mean at rest, by the component of the modes kept for 1 kHz.
double seated_frequency(const RollPart &roll);

std::vector<Check> roll_on_rigid_seats();   ///< first frequency of the backup roll, from the beam to the solid
std::vector<Check> roll_deflection();       ///< shape and stiffness of the backup roll under an even load
std::vector<Check> component_identities();  ///< mass, rigid motion, symmetry
}  // namespace mill::verify
