#pragma once
#include "core/model/roller_setup.h"
#include "fem/bearing/roller_contact.h"

namespace mill::verify {
/// A roller of the demo bearing between its raceways, 12 mm thick.
RollerSetup demo_roller();
/// The same as finely meshed as the manual has it.
RollerSetup fine_demo_roller();
/// m, crown of tapered rollers by ISO/TS 16281 on the demo roller, `x` (m) from its middle.
double demo_roller_drop(double x);

/// Meshes in the system's temporary folder, condensed.
fem::CondensedRoller condensed(const RollerSetup &setup);
}  // namespace mill::verify
