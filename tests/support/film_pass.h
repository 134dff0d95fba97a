#pragma once
#include "reduce/bite/bite.h"

/// Fourth stand of a tandem mill with an oil film, 0.789 -> 0.577 mm at 18.2 m/s (X. Liu et al., J.
/// Vibroengineering 19 (2017), condition 2).
inline mill::bite::RollBite film_pass()
{
  mill::bite::RollBite bite;
  bite.roll_radius             = 0.300;
  bite.roll                    = {2.1e11, 0.3, 7850};
  bite.roll_speed              = 18.2;
  bite.strip.width             = 1.206;
  bite.strip.entry_thickness   = 0.789e-3;
  bite.strip.exit_thickness    = 0.577e-3;
  bite.strip.entry_tension     = 180e6;
  bite.strip.exit_tension      = 189e6;
  bite.strip.initial_thickness = 3e-3;
  bite.strip.flow_stress.law   = mill::FlowStressLaw::reduction_power;
  bite.strip.flow_stress.k     = 84.6 * 9.80665e6;
  bite.strip.flow_stress.eps0  = 0.00817;
  bite.strip.flow_stress.n     = 0.3;
  mill::Friction &film         = bite.strip.friction;
  film.law                     = mill::FrictionLaw::film;
  film.mu0                     = 0.012;
  film.mu1                     = 0.142;
  film.decay                   = 2.43e6;
  film.viscosity               = 0.005;
  film.pressure_viscosity      = 2e-8;
  return bite;
}

/// First pass of a cluster mill, 0.260 -> 0.180 mm between rolls of 69.6 mm, friction factors (E. Brusa, L. Lemma,
/// J. Mater. Process. Technol. 209 (2009) 2436; factors chosen).
inline mill::bite::RollBite factor_pass()
{
  mill::bite::RollBite bite;
  bite.roll_radius                 = 0.0348;
  bite.roll                        = {2.1e11, 0.3, 7850};
  bite.strip.width                 = 0.505;
  bite.strip.entry_thickness       = 0.260e-3;
  bite.strip.exit_thickness        = 0.180e-3;
  bite.strip.entry_tension         = 38e3 / (0.505 * 0.260e-3);
  bite.strip.exit_tension          = 35e3 / (0.505 * 0.180e-3);
  bite.strip.flow_stress.k         = 1.2e9;
  bite.strip.friction.law          = mill::FrictionLaw::factor;
  bite.strip.friction.entry_factor = 0.10;
  bite.strip.friction.exit_factor  = 0.12;
  return bite;
}
