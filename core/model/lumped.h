#pragma once
#include "core/model/campbell.h"
#include "core/model/dynamics_settings.h"
#include "core/model/frequency_response.h"
#include "core/model/given.h"
#include "core/model/pass.h"
#include <vector>

namespace mill {
/// kind = "lumped": starts at the lumped model.
struct Lumped {
  GivenValues given;
  std::vector<Pass> passes;
  DynamicsSettings dynamics;
  FrequencyResponseSettings frequency_response;
  CampbellSettings campbell;
  std::vector<DriveOrder> drive;
};
}  // namespace mill
