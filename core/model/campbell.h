#pragma once
#include "core/model/material.h"
#include "core/model/roll_kind.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
/// [campbell]: over which speeds the modes are looked at, and which orders of what turns.
struct CampbellSettings {
  std::array<double, 2> speeds = {not_given, not_given};  ///< m/s, of the rolls' surface; absent: by passes
  std::array<double, 2> working_speeds = {not_given, not_given};  ///< m/s; absent: those of the passes
  int roll_orders                      = 5;                       ///< orders 1 to this of work and backup rolls
  int bearing_harmonics                = 2;          ///< of every pass frequency of the roll-neck bearings
  double work_roll_diameter            = not_given;  ///< m, where no roll is drawn
  double backup_roll_diameter          = not_given;  ///< m, where no roll is drawn
};

/// [[drive.order]]: something of the drive that happens `count` times per turn of a roll.
struct DriveOrder {
  std::string name;  ///< "pinion teeth"
  RollKind per_turn_of = RollKind::work_roll;
  double count         = 0;  ///< -, behind a gear no whole number
};
}  // namespace mill
