#pragma once
#include "reduce/bite/bite.h"
#include "reduce/bite/slab/bland_ford_equations.h"

namespace mill::bite {
/// Slab solution of Bland and Ford: strain hardening, tensions, Coulomb friction that is given, follows the roll
/// speed or an oil film, and a gap that opens or closes.  Of several flattened radii the smallest is returned.
///
/// @param arc           rigid or hitchcock
/// @param curve_points  of the curves along the arc, on each side of the neutral point; below two: no curves
///
/// Derivatives: by every Input, exact; by friction it is that by a number added to mu, the film following.  Roll
/// speed and gap rate are nan where no roll speed is given.  Torque: friction stress times the radius of the roll,
/// (8.19).
///
/// @throws InputError   exit not thinner than entry; friction, width or radius not positive; tension at or above
/// the
///                      flow stress; friction that is a factor; no roll speed where the law or the gap needs one;
///                      neutral point outside the arc, with the friction that would be needed
/// @throws SolverError  no flattened radius exists below 20 R; film and speeds do not settle
/// Cost: about 10 us on a given arc, some 30 us with flattening (constant flow stress half of it), curves 0.1 us
/// per point. Source: D. R. Bland, H. Ford, Proc. Inst. Mech. Eng. 159 (1948) 144; J. H. Hitchcock, Roll Neck
/// Bearings, ASME 1935; moving gap and film: X. Liu et al., J. Vibroengineering 19 (2017).
BiteState solve_bland_ford(const RollBite &bite, Arc arc, int curve_points = 101);

/// A state that can be differentiated, at a given radius of the arc.
template <class T> struct BlandFordState {
  BlandFordContact<T> contact;
  T force;   ///< N
  T torque;  ///< N m, one roll
};

/// @param entry_speed  m/s, start of the iteration and its result
template <class T>
BlandFordState<T> bland_ford_state(const RollBite &bite, const PassInputs<T> &in, double &entry_speed,
                                   const HillRules &rules)
{
  BlandFordState<T> s;
  s.contact        = settled_bland_ford(bite.strip, in, entry_speed);
  const auto sides = bland_ford_force(bite.strip, in, s.contact, rules);
  s.force          = bite.strip.width * (sides.entry + sides.exit);
  s.torque         = bite.strip.width * bite.roll_radius * s.contact.friction * (sides.entry - sides.exit);
  return s;
}
}  // namespace mill::bite
