#pragma once
#include "core/model/strip.h"
#include <vector>

/// One friction law of every kind that is not a plain coefficient: speed, film, factor.
inline std::vector<mill::Friction> laws_of_friction()
{
  mill::Friction speed, film, factor;
  speed.law               = mill::FrictionLaw::speed;
  speed.at_unit_speed     = 0.0667;
  speed.per_log_speed     = -0.0066;
  film.law                = mill::FrictionLaw::film;
  film.mu0                = 0.012;
  film.mu1                = 0.142;
  film.decay              = 2.43e6;
  film.viscosity          = 0.005;
  film.pressure_viscosity = 2e-8;
  factor.law              = mill::FrictionLaw::factor;
  factor.entry_factor     = 0.10;
  factor.exit_factor      = 0.12;
  return {speed, film, factor};
}
