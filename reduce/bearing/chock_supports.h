#pragma once
#include "core/model/roller_bearing.h"
#include <string>
#include <vector>

namespace mill::bearing {
/// The bearing with its chock held in another way.
struct ChockSupport {
  std::string name;  ///< "chock on two feet"
  RollerBearing bearing;
};

/// How the chock of this bearing is held: "chock on two feet", "chock on its whole face", ..., "cup held".
std::string support_name(const RollerBearing &bearing);

/// The other ways in which chocks are held, where the case does not say which one applies: on two feet a sixth of
/// the width each (bending cylinders), on the whole face, on its middle third (a screw), and, when not even a
/// chock was named, the cup held all around.  Empty when the support was given or nothing of the chock is counted.
std::vector<ChockSupport> open_supports(const RollerBearing &bearing);
}  // namespace mill::bearing
