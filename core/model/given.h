#pragma once
#include "core/base/errors.h"
#include "core/base/parameter.h"
#include <map>
#include <string>

namespace mill {
/// Values that replace computed ones, by name: M1..M6, K1..K7, Kzc1..Kzc4, Kzc1_across..Kzc4_across, C, K_Zy,
/// K_ZW. A tolerance given with a value is its error estimate.
struct GivenValue {
  Parameter parameter;
  Place place;
};
using GivenValues = std::map<std::string, GivenValue>;
}  // namespace mill
