#pragma once
#include "reduce/bite/linear/linear_coefficients.h"
#include <array>
#include <string>
#include <vector>

// How the steady bite and the coefficients of the vibrating bite move with every number of a pass.  theory.md 27.1
namespace mill::bite {
/// Numbers of a pass, of its roll and of the laws of its strip.
enum class PassNumber {
  entry_thickness,     ///< m
  exit_thickness,      ///< m
  entry_tension,       ///< Pa
  exit_tension,        ///< Pa
  width,               ///< m
  roll_speed,          ///< m/s
  roll_radius,         ///< m, before it is flattened
  youngs_modulus,      ///< Pa, of the roll
  poisson_ratio,       ///< -, of the roll
  stress_factor,       ///< -, one: factor on the flow stress of any law, also of a table
  stress,              ///< Pa, k
  pre_strain,          ///< -, eps0
  exponent,            ///< -, n
  initial_stress,      ///< Pa, k0
  initial_thickness,   ///< m
  friction,            ///< -, Coulomb's mu; from here the constants of the friction laws in their order
  shear_limit,         ///< -, none that a bite is differentiated by, as both factors
  entry_factor,        ///< -
  exit_factor,         ///< -
  friction_scale,      ///< -, scale of the speed law
  at_unit_speed,       ///< -
  per_log_speed,       ///< -
  mu0,                 ///< -
  mu1,                 ///< -
  decay,               ///< 1/m
  viscosity,           ///< Pa s
  pressure_viscosity,  ///< 1/Pa
  film_factor          ///< -
};
constexpr int n_pass_numbers           = int(PassNumber::friction) + int(n_friction_constants);
template <class T> using PerPassNumber = std::array<T, n_pass_numbers>;

/// What a case file calls the number.
struct PassNumberName {
  std::string key;   ///< "condition.entry_thickness", "oil.viscosity"
  std::string name;  ///< in words
  std::string unit;  ///< SI, "m"
};
PassNumberName name_of(PassNumber number);

/// Value of a number in SI; nan: not given (initial thickness).
double value_of(const RollBite &bite, PassNumber number);

/// The numbers this bite depends on: those of its laws that are given and not zero.
std::vector<PassNumber> numbers_of(const RollBite &bite);

/// Bite with one number times a factor.
RollBite with_number_scaled(RollBite bite, PassNumber number, double factor);

/// Steady state and coefficients with their derivatives d/d ln p = p d/dp by every number of the pass; zero where
/// the bite does not depend on it or it is zero.  R' follows the force by (8.9); the coefficients are derivatives
/// with R' held, which moves from one steady state to the next.  theory.md (27.1)-(27.3)
struct LinearSensitivity {
  PerPassNumber<double> flattened_radius{};  ///< m
  PerPassNumber<double> friction{};          ///< -
  PerPassNumber<double> film_thickness{};    ///< m; zero without a film
  PerPassNumber<double> force{};             ///< N
  PerPassNumber<double> entry_speed{};       ///< m/s
  PerPassNumber<double> exit_speed{};        ///< m/s
  PerPassNumber<double> neutral_position{};  ///< m
  PerPassNumber<LinearCoefficients> by{};    ///< of the coefficients, in the units of their rows
};

/// Exact: the steady state and its linearisation in numbers that carry the derivatives by all numbers and, of
/// each, those by gap, gap rate, tensions and entry thickness.
/// @param state  of the bite by Bland and Ford on Hitchcock's arc
/// @throws InputError, SolverError  as linear_coefficients
/// Cost: 0.2 ms
LinearSensitivity linear_sensitivity(const RollBite &bite, const BiteState &state, Linearisation scheme);
}  // namespace mill::bite
