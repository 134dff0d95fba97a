#pragma once
#include "app/study/study_folder.h"
#include <vector>

namespace mill {
/// Two inputs that vary together, by their places among the keys.
struct KeyCorrelation {
  std::size_t a = 0, b = 0;
  double value = 0;  ///< -, of the normal copula, -1 < value < 1
};

/// Of --correlate "KEY1,KEY2=0.5".  @throws InputError  another form, a key that is not varied, one key twice
std::vector<KeyCorrelation> correlations_of(const Study &study);
}  // namespace mill
