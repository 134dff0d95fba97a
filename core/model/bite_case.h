#pragma once
#include "core/model/bite_setup.h"
#include "core/model/given.h"
#include "core/model/material.h"
#include "core/model/pass.h"
#include "core/model/strip.h"
#include <vector>

namespace mill {
/// kind = "bite": the strip between two work rolls, nothing of the stand.
struct BiteCase {
  Material steel;            ///< of the rolls
  double roll_diameter = 0;  ///< m, work roll
  Strip strip;
  std::vector<Pass> passes;  ///< load: a measured force for comparison with the computed one
  BiteSetup bite;
  GivenValues published;  ///< only compared with the computed values
};
}  // namespace mill
