#pragma once
#include "core/model/material.h"
#include <array>
#include <string>
#include <vector>

// The strip in the bite and what lies between it and the rolls.
namespace mill {
/// Plane-strain flow stress k_f(eps) with eps = ln(h0/h) unless the law says otherwise.  theory.md 8
struct FlowStress {
  std::string law = "constant";  ///< constant | swift | ludwik | voce | power | reduction-power | table
  double k        = 0;           ///< Pa, the constant, or the factor of the law
  double eps0     = 0;           ///< -
  double n        = 0;           ///< -
  double k0       = 0;           ///< Pa, initial value of ludwik and voce
  std::vector<std::array<double, 2>> table;  ///< (strain -, stress Pa)
};

/// Friction between roll and strip.  theory.md 8
struct Friction {
  std::string law    = "coulomb";  ///< coulomb | factor | speed | film
  double coefficient = 0;          ///< -, coulomb: mu
  /// Largest friction stress over the shear yield stress k_f/2, for the models that know one; nan: no limit.
  double shear_limit  = 1;  ///< -
  double entry_factor = 0;  ///< -, factor: friction stress over shear yield stress before the neutral point
  double exit_factor  = 0;  ///< -, factor: behind it
  /// speed: mu = scale (at_unit_speed + per_log_speed ln(v / (1 m/s))), v the speed of the roll's surface
  double scale         = 1;  ///< -
  double at_unit_speed = 0;  ///< -
  double per_log_speed = 0;  ///< -, negative: falls with speed
  /// film: mu = mu0 + mu1 exp(-decay h_f), h_f the mean oil film of the bite
  double mu0                = 0;  ///< -
  double mu1                = 0;  ///< -
  double decay              = 0;  ///< 1/m
  double viscosity          = 0;  ///< Pa s, of the oil at the temperature and pressure of the inlet
  double pressure_viscosity = 0;  ///< 1/Pa, gamma of viscosity exp(gamma p)
  double film_factor        = 3;  ///< -, factor of the film law
};

/// Strip in the bite.
struct Strip {
  double width             = 0;          ///< m
  double entry_thickness   = 0;          ///< m
  double exit_thickness    = 0;          ///< m
  double entry_tension     = 0;          ///< Pa, back tension, positive in tension
  double exit_tension      = 0;          ///< Pa, front tension
  double initial_thickness = not_given;  ///< m, reference of the strain; absent: entry thickness
  double youngs_modulus    = 210e9;      ///< Pa, elastic zones before and behind the bite
  double poisson_ratio     = 0.3;        ///< -
  FlowStress flow_stress;
  Friction friction;
};
}  // namespace mill
