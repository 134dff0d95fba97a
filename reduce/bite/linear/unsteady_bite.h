#pragma once
#include "reduce/bite/linear/linear_coefficients.h"
#include "reduce/bite/quadrature.h"
#include <array>

// The bite at one moment of a vibrating mill, at any amplitude.  theory.md 26.1
namespace mill::bite {
/// A steady bite and what keeps its steady value while it vibrates.
struct UnsteadyBite {
  RollBite bite;
  Linearisation scheme      = Linearisation::sequential;
  double flattened_radius   = 0;  ///< m, of the arc, held
  double steady_entry_speed = 0;  ///< m/s
  double steady_exit_speed  = 0;  ///< m/s
  double steady_friction    = 0;  ///< -
  HillRules rules;
};

/// @param state  of `bite` by Bland and Ford
/// @throws InputError  no roll speed given; a factor as friction
UnsteadyBite unsteady_bite(const RollBite &bite, const BiteState &state, Linearisation scheme);

/// Gap (m), gap rate (m/s), entry tension (Pa), exit tension (Pa), entry thickness (m): the order of StripRow.
using Moment = std::array<double, 5>;
Moment steady_moment(const UnsteadyBite &bite);

/// What the bite answers.  Without contact: no force, and the strip at the speed of the rolls, to which a bite
/// that becomes zero tends.
struct BiteAnswer {
  double entry_speed      = 0;          ///< m/s
  double exit_speed       = 0;          ///< m/s
  double force            = 0;          ///< N
  double friction         = 0;          ///< -
  double film_thickness   = not_given;  ///< m, film law only
  double neutral_position = 0;          ///< m, on the arc: at one of its ends where the rolls skid
  double exit_position    = 0;          ///< m
  bool contact            = true;
  /// Distance of the angle t of the neutral point from both ends of the arc, before it is kept on the arc; below
  /// zero: the rolls skid, the strip is slower (exit) or faster (entry) than the rolls all along the arc.
  double from_exit  = 0;  ///< rad
  double from_entry = 0;  ///< rad
};

/// Bland and Ford's bite with moving gap (8.5)-(8.8), (8.15)-(8.21) at one moment, by the scheme.
/// A tension beyond `tension_limit` of the flow stress is replaced by that, so that a solver may look across the
/// edge.
/// @throws SolverError  implicit scheme: film and speeds do not settle
/// @throws InputError   strain outside a table
/// Cost: 5 us, 12 points on each side of the neutral point.
BiteAnswer bite_at(const UnsteadyBite &bite, const Moment &moment);

/// With exact derivatives by the five numbers of the moment.  At the steady moment: linear_coefficients.
/// Cost: 10 us
struct BiteSlopes {
  BiteAnswer answer;
  LinearCoefficients by;
};
BiteSlopes bite_slopes_at(const UnsteadyBite &bite, const Moment &moment);

/// `from_exit` and `from_entry` of the answer at a sixth of its cost; 1 rad each without contact.
std::array<double, 2> neutral_reserve(const UnsteadyBite &bite, const Moment &moment);

/// What is left of the draft, m: entry thickness less the thickness at which the strip would leave the rolls,
///   h_e - h_d - R g^2/(4 v^2) (g > 0),   h_e - h_d (g <= 0).  theory.md (26.3)
/// Not positive: the strip does not touch the rolls.
double contact_reserve(const UnsteadyBite &bite, const Moment &moment);

/// Share of the plane-strain flow stress at which a tension tears the strip.
constexpr double tension_limit = 0.999;

/// 1 - tension/(limit flow stress) at entry and exit; below zero the strip yields under its tension.
std::array<double, 2> yield_reserve(const UnsteadyBite &bite, const Moment &moment);
}  // namespace mill::bite
