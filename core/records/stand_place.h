#pragma once
#include "core/base/choice.h"
#include <string>

namespace mill {
/// What the name of a part or of a point of a stand says: "upper work-roll chock", "housing, chock seat".
struct StandPlace {
  bool lower = false;  ///< of the lower half; a housing, a screw and a cylinder are of the upper one
  bool work = false, backup = false;  ///< of such a roll
  bool roll = false, chock = false, seat = false, end = false, frame = false, housing = false, cylinder = false;
};
StandPlace stand_place(const std::string &name);

/// The foundation, as the end of a damper or a spring.
constexpr const char *ground_place = "ground";

/// The spring of a detailed stand that holds the bearings of a backup roll in their chock.
enum class SeatSpring { upper, lower };
constexpr auto words_of(SeatSpring)
{
  return choice_words<SeatSpring>("upper chock and K_Zy", "lower chock and K_Zy");
}

/// Joins the names of springs in series without a mass between them.
constexpr const char *series_mark = " + ";

/// Whether a connection has this spring among those that it joins: "cylinder body + upper chock and K_Zy".
bool has_spring(const std::string &connection, SeatSpring spring);
}  // namespace mill
