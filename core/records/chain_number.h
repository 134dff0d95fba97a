#pragma once
#include "core/base/choice.h"
#include <optional>
#include <string_view>

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

/// A spring of a stand; a bearing yields along its load, or across it.
struct NamedSpring {
  ChainNumber number;
  bool across = false;
};
/// "K3", "Kzc2_across"; nothing for another name.
inline std::optional<NamedSpring> spring_named(std::string_view name)
{
  constexpr std::string_view ending = "_across";
  const bool across = name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending;
  if (across)
    name.remove_suffix(ending.size());
  const auto number = choice_named<ChainNumber>(name);
  return number ? std::optional<NamedSpring>({*number, across}) : std::nullopt;
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
