#pragma once
#include "core/model/advice.h"
#include "core/model/bite_setup.h"
#include "core/model/campbell.h"
#include "core/model/chatter.h"
#include "core/model/contact_settings.h"
#include "core/model/dynamics_settings.h"
#include "core/model/estimate.h"
#include "core/model/frame.h"
#include "core/model/frequency_response.h"
#include "core/model/given.h"
#include "core/model/housing.h"
#include "core/model/material.h"
#include "core/model/oil_film_bearing.h"
#include "core/model/pass.h"
#include "core/model/roll.h"
#include "core/model/roller_bearing.h"
#include "core/model/strip.h"
#include <vector>

namespace mill {
/// kind = "four-high"
struct FourHigh {
  Material steel;
  Roll work_roll, backup_roll;
  std::vector<RollerBearing> bearings;
  std::vector<OilFilmBearing> oil_films;
  Frame frame;
  MillHousing housing;
  Screwdown screwdown;
  Strip strip;
  std::vector<Pass> passes;
  ContactSettings upper_contact, lower_contact;  ///< upper: K3, lower: K5
  BiteSetup bite;
  DynamicsSettings dynamics;
  FrequencyResponseSettings frequency_response;
  CampbellSettings campbell;
  std::vector<DriveOrder> drive;
  StandSpan span;            ///< strip before and behind the stand, for chatter
  ChatterAnalysis analysis;  ///< of chatter
  StandAdvice advice;
  Estimates estimates;  ///< values of the records above that were not given
  GivenValues given;
  GivenValues published;  ///< same names; only compared with the computed values
};
}  // namespace mill
