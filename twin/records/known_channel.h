#pragma once
#include "core/base/choice.h"

namespace mill::twin {
/// Channels that are more than a place of the stand; --channel NAME=.. gives a column one of these names.
enum class KnownChannel { force, load_cell, speed, exit_speed, entry_speed, strip_speed };
constexpr auto words_of(KnownChannel)
{
  return choice_words<KnownChannel>("force", "load_cell", "speed", "exit_speed", "entry_speed", "strip_speed");
}

/// The force that drives the stand.
constexpr bool is_driving_force(const std::string_view name)
{
  return name == word_of(KnownChannel::force);
}
}  // namespace mill::twin
