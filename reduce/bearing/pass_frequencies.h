#pragma once
#include "core/model/roller_bearing.h"

namespace mill::bearing {
/// How often parts of a rolling bearing meet while its inner ring makes one turn and its outer ring stands,
/// rolling without slip.  NaN without pitch or roller diameter.  theory.md 32.5
struct PassFrequencies {
  double cage;    ///< turns of the cage (FTF)
  double outer;   ///< rollers that pass a point of the outer raceway (BPFO)
  double inner;   ///< rollers that pass a point of the inner raceway (BPFI)
  double roller;  ///< turns of a roller about its axis, seen from the cage (BSF): a point of it meets each raceway
                  ///< so often
};

/// Of balls or rollers by their number in a row, diameter and pitch diameter, m, and contact angle, rad.  (32.10)
PassFrequencies pass_frequencies(int elements, double diameter, double pitch, double contact_angle);

/// By the pitch circle and the mean contact angle.  (32.10)
PassFrequencies pass_frequencies(const RollerBearing &bearing);

/// The same of a tapered bearing as cones that roll on each other about one apex, without any diameter.  (32.11)
/// NaN for a cylindrical bearing.
PassFrequencies of_rolling_cones(const RollerBearing &bearing);
}  // namespace mill::bearing
