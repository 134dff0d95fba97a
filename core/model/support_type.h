#pragma once
#include "core/base/choice.h"

namespace mill {
/// What holds one roll of a planar stack from the ground.
enum class SupportType {
  radial,     ///< force along the displacement, the same law in every direction
  isotropic,  ///< the law in y, its tangent at the force of the pass in x
  guide,      ///< a spring along one direction
  rollers     ///< two one-sided rollers with preload behind a roll
};
constexpr auto words_of(SupportType)
{
  return choice_words<SupportType>("radial", "isotropic", "guide", "rollers");
}
}  // namespace mill
