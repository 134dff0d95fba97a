#pragma once
#include "core/model/roller_bearing.h"
#include "reduce/bearing/roller_law.h"

namespace mill::bearing {
/// Diametral clearance of a bearing, m: its `end_play` turned into radial play, else its `radial_clearance`.
double diametral_clearance(const RollerBearing &bearing);

/// Radial (diametral) play that an axial play of a tapered bearing amounts to, m:  end_play tan(cup_angle).  Both
/// take the same approach from every roller,  sin(a) end_play / 2 = cos(a) clearance / 2.
double clearance_of_end_play(double end_play, double cup_angle);

/// What clearance, end play or preload adds to the approach of every roller at the concentric position, m:
/// negative with clearance.  A preload of F_0 on each row is the approach at which its rollers carry F_0/(Z
/// sin(cup_angle)).
/// @throws InputError  preload on a bearing without contact angle
double approach_offset(const RollerBearing &bearing, const RollerLaw &law);

/// N, load of each roller under the bearing's preload; 0 without.  Errors as approach_offset.
double preloaded_roller(const RollerBearing &bearing);
}  // namespace mill::bearing
