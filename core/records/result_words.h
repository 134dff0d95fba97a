#pragma once
#include "core/base/choice.h"

namespace mill {
/// Words that are parts of names of results, "marks.control_roll.per_turn", where code asks for them.
enum class ResultWord {
  frequency,
  force,
  speed,
  distance,
  growth_rate,
  critical_speed,
  per_turn,
  rotation,
  mode,
  buckling_factor,
  leaving_force,
  roller_load,
  velocity,
  acceleration,
  least_guide,
  x,
  y,
  contact,
  crown,
  edge_drop,
  wedge,
  shift,
  bending_force,
  q_max,
  peak_pressure,
  gap_first_kind,
  gap_second_kind,
  friction_slope,
  speed_slope
};
constexpr auto words_of(ResultWord)
{
  return choice_words<ResultWord>(
      "frequency", "force", "speed", "distance", "growth_rate", "critical_speed", "per_turn", "rotation", "mode",
      "buckling_factor", "leaving_force", "roller_load", "velocity", "acceleration", "least_guide", "x", "y",
      "contact", "crown", "edge_drop", "wedge", "shift", "bending_force", "q_max", "peak_pressure",
      "gap_first_kind", "gap_second_kind", "friction_slope", "speed_slope");
}

constexpr bool is_word(const std::string_view part, const ResultWord word)
{
  return part == word_of(word);
}
}  // namespace mill
