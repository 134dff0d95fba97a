#pragma once
#include "core/base/choice.h"

namespace mill {
/// Numbers of the chain of six masses and of what its springs are made of, by their names in results.json, in
/// [given] and in models.
enum class ChainNumber {
  M1,
  M2,
  M3,
  M4,
  M5,
  M6,
  K1,
  K2,
  K3,
  K4,
  K5,
  K6,
  K7,
  K_Zy,
  K_Zy_lower,
  K_ZW,
  Kzc1,
  Kzc2,
  Kzc3,
  Kzc4
};
constexpr auto words_of(ChainNumber)
{
  return choice_words<ChainNumber>("M1", "M2", "M3", "M4", "M5", "M6", "K1", "K2", "K3", "K4", "K5", "K6", "K7",
                                   "K_Zy", "K_Zy_lower", "K_ZW", "Kzc1", "Kzc2", "Kzc3", "Kzc4");
}

/// One bearing of a roll.
inline bool is_bearing(const std::string_view name)
{
  const auto number = choice_named<ChainNumber>(name);
  return number && *number >= ChainNumber::Kzc1;
}

/// A spring that is the contact of a backup roll with a work roll.
inline bool is_roll_contact(const std::string_view name)
{
  const auto number = choice_named<ChainNumber>(name);
  return number == ChainNumber::K3 || number == ChainNumber::K5;
}
}  // namespace mill
