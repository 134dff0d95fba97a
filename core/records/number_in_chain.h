#pragma once
#include "core/model/lumped_model.h"
#include "core/records/chain_number.h"

namespace mill {
/// M1 .. M6.
constexpr bool is_mass_of_chain(const ChainNumber number)
{
  return number <= ChainNumber::M6;
}
/// K1 .. K7.
constexpr bool is_spring_of_chain(const ChainNumber number)
{
  return number >= ChainNumber::K1 && number <= ChainNumber::K7;
}

/// The mass or the spring of a model; nullptr: the number is neither, a bearing or a part of a spring.
/// @param Model  LumpedModel or const LumpedModel
template <class Model> auto number_in_chain(Model &model, const ChainNumber number) -> decltype(&model.M[0])
{
  if (is_mass_of_chain(number))
    return &model.M[std::size_t(number) - std::size_t(ChainNumber::M1)];
  return is_spring_of_chain(number) ? &model.K[std::size_t(number) - std::size_t(ChainNumber::K1)] : nullptr;
}
}  // namespace mill
