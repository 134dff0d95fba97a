#pragma once
#include "reduce/bite/bite.h"
#include "reduce/bite/slab/hu_ehmann_equations.h"

namespace mill::bite {
/// Slab solution with friction factors, tensions, hardening and a moving gap.  A constant flow stress is solved in
/// closed form, any other by quadrature of the same equation.  Arguments, derivatives and errors as
/// solve_bland_ford; the friction law must be "factor", and the derivative by friction moves both factors. Cost:
/// about 5 us on a given arc with a constant flow stress, some 80 us otherwise. Source: P.-H. Hu, K. F. Ehmann,
/// Int. J. Mach. Tools Manuf. 40 (2000) 1; without its approximations, theory.md 8.8.
BiteState solve_hu_ehmann(const RollBite &bite, Arc arc, int curve_points = 101);

/// Force per width as published, N/m: h_c/R compared with one and x/R compared with B are left out of the
/// friction.
/// @param shear_yield    Pa, half the plane-strain flow stress
/// @param exit_position  m, zero where the gap rests
double published_hu_ehmann_force(double radius, double entry_thickness, double gap, double entry_tension,
                                 double exit_tension, double shear_yield, double entry_factor, double exit_factor,
                                 double exit_position);
}  // namespace mill::bite
