#pragma once
#include "core/model/roll_kind.h"
#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace mill {
/// [[monitoring.ball_bearing]]: what its faults are heard at.
struct BallBearing {
  std::string name;
  RollKind roll         = RollKind::work_roll;                       ///< with which its inner ring turns
  int balls             = 0;                                         ///< of one row
  double ball_diameter  = std::numeric_limits<double>::quiet_NaN();  ///< m
  double pitch_diameter = std::numeric_limits<double>::quiet_NaN();  ///< m
  double contact_angle  = 0;                                         ///< rad
};

/// [monitoring]: how the records of a mill are named and judged.
struct Monitoring {
  std::vector<std::string> channel_pairs;           ///< "AI_07=upper_work_roll"
  std::vector<std::string> severity;                ///< "2.3 mm/s", upper ends of zones A, B, C, as written
  std::array<double, 2> third_octave = {125, 240};  ///< Hz
  std::array<double, 2> fifth_octave = {550, 650};  ///< Hz
  double limit = std::numeric_limits<double>::quiet_NaN();  ///< m/s2, 0-peak, the mill's own; NaN: none
  std::string baseline;                                     ///< folder of an earlier analysis; empty: none
  std::vector<BallBearing> ball_bearings;
  std::map<std::string, std::string> channels() const;  ///< plant's name -> place
  std::vector<double> zones() const;                    ///< m/s
};
}  // namespace mill
