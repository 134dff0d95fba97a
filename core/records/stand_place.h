#pragma once
#include <string>

namespace mill {
/// What the name of a part or of a point of a stand says: "upper work-roll chock", "housing, chock seat".
struct StandPlace {
  bool lower = false;  ///< of the lower half; a housing, a screw and a cylinder are of the upper one
  bool work = false, backup = false;  ///< of such a roll
  bool roll = false, chock = false, seat = false, end = false, frame = false, housing = false, cylinder = false;
};
StandPlace stand_place(const std::string &name);
}  // namespace mill
