#pragma once
#include "reduce/bite/bite.h"

// Member lists of what a bite is given; see core/base/each_member.h.
namespace mill::bite {
// Of the rolls only their flattening is followed.
template <class Io> void each_member(Io &&io, const RollBite &record)
{
  const auto &[strip, roll_radius, roll, roll_speed, gap_rate] = record;
  io("strip", strip);
  io("roll_radius", roll_radius);
  io("roll", at_rest(roll));
  io("roll_speed", roll_speed);
  io("gap_rate", gap_rate);
}
}  // namespace mill::bite
