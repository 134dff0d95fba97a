#pragma once
#include "app/stages/bearing/bearing_study.h"
#include "core/base/each_member.h"
#include <string>
#include <vector>

namespace mill {
/// Every state that was solved for one question to a bearing.
struct SolvedBearing {
  std::vector<bearing::AssemblyState> curve, standard_curve, rigid_curve;
  bearing::AssemblyState at, standard, rigid, palmgren;
  double slice_deviation = 0;
  std::vector<bearing::AssemblyState> companions, supports, arrangements;
};

template <class Io, class R, if_record<R, SolvedBearing> = 0> void each_member(Io &&io, R &record)
{
  auto &[curve, standard_curve, rigid_curve, at, standard, rigid, palmgren, slice_deviation, companions, supports,
         arrangements] = record;
  io("curve", curve);
  io("standard_curve", standard_curve);
  io("rigid_curve", rigid_curve);
  io("at", at);
  io("standard", standard);
  io("rigid", rigid);
  io("palmgren", palmgren);
  io("slice_deviation", slice_deviation);
  io("companions", companions);
  io("supports", supports);
  io("arrangements", arrangements);
}

/// Everything that they depend on, as text; its hash is the key of the cache.
/// @param largest_load  N, on one roller, that its mesh is made for
std::string bearing_inputs_text(const BearingQuestion &question, double largest_load);
}  // namespace mill
