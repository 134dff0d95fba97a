#pragma once
#include "core/base/choice.h"
#include <string>
#include <string_view>

namespace mill {
/// SI units of results and channels on which it depends how they are shown or used.
enum class SiUnit { one, metre, radian, second, hertz, newton, speed, acceleration, stiffness };
constexpr auto words_of(SiUnit)
{
  return choice_words<SiUnit>("1", "m", "rad", "s", "Hz", "N", "m/s", "m/s2", "N/m");
}

constexpr bool is_in(const std::string_view unit, const SiUnit which)
{
  return unit == word_of(which);
}

/// Whether it is the unit of a pure number, in any of its spellings.
constexpr bool is_pure(const std::string_view unit)
{
  return unit.empty() || unit == "-" || is_in(unit, SiUnit::one);
}

/// What follows a number, " N/m"; nothing for a pure number.
inline std::string after_number(const std::string_view unit)
{
  return is_pure(unit) ? "" : " " + std::string(unit);
}

/// What follows a name, " [N/m]"; nothing for a pure number.
inline std::string after_name(const std::string_view unit)
{
  return is_pure(unit) ? "" : " [" + std::string(unit) + "]";
}
}  // namespace mill
