#pragma once
#include "verify/verification.h"
#include <vector>

// Cases of one roll at rest or on rigid seats against beam theory.
namespace mill::verify {
std::vector<Check> roll_on_rigid_seats();   ///< first frequency of the backup roll, from the beam to the solid
std::vector<Check> roll_deflection();       ///< shape and stiffness of the backup roll under an even load
std::vector<Check> component_identities();  ///< mass, rigid motion, symmetry
}  // namespace mill::verify
