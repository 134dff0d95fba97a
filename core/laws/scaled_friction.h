#pragma once
#include "friction_law.h"

// Friction as a whole, whatever the law: what a fit to measured values multiplies.
namespace mill {
/// With the friction stress times a factor at the same film and speed: Coulomb's coefficient, both friction
/// factors, the scale of a law by speed, mu0 and mu1 of a film.
Friction scaled(Friction friction, double factor);

/// Factor that the law itself carries, one without: scaled(friction, x / own_scale(friction)) carries x.
double own_scale(const Friction &friction);

/// A friction that no factor makes larger.
bool is_zero(const Friction &friction);
}  // namespace mill
