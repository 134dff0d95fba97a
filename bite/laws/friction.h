#pragma once
#include "core/numerics/derivative.h"
#include "bite/laws/flow_stress.h"
#include "core/model/strip.h"

// Friction between roll and strip as a number per pass.  theory.md 8.7
namespace mill::bite {
/// Constants of a friction law that can be differentiated; members as Friction.
template <class T> struct FrictionLaw {
  std::string law;
  T coefficient, scale, at_unit_speed, per_log_speed;
  T mu0, mu1, decay, viscosity, pressure_viscosity, film_factor;
};

/// What the friction laws look at; T is double, complex or a number with derivatives.  Law is Friction or
/// FrictionLaw<T>.
template <class T> struct Inlet {
  T roll_speed, entry_speed, exit_speed;  ///< m/s
  T radius;                               ///< m, of the arc
  T arc_length;                           ///< m, line of centres to entry
  T entry_pressure;  ///< Pa, k_fe - sigma_e: what the film has to carry where the strip yields
};

/// Mean oil film of the bite, m, (8.20).  Law "film".
template <class Law, class T> T film_thickness(const Law &law, const Inlet<T> &in)
{
  // 1 - exp(-gamma p) without cancellation: gamma p is 1e-3 for thin oils
  const T carried = -expm1(-law.pressure_viscosity * in.entry_pressure);
  return law.film_factor * law.pressure_viscosity * law.viscosity * in.radius * (in.roll_speed + in.entry_speed) *
         (2.0 * in.roll_speed + in.entry_speed + in.exit_speed) /
         (in.arc_length * (in.roll_speed + in.exit_speed) * carried);
}

/// Coulomb coefficient under a film, film in metres, (8.21).
template <class Law, class T> T film_friction(const Law &law, const T &film)
{
  using std::exp;
  return law.mu0 + law.mu1 * exp(-law.decay * film);
}

/// Coulomb coefficient that falls (or rises) with the logarithm of the speed of the roll's surface, (8.22).
template <class Law, class T> T speed_friction(const Law &law, const T &roll_speed)
{
  using std::log;
  return law.scale * (law.at_unit_speed + law.per_log_speed * log(roll_speed));
}

/// True if the law needs the speed of the roll.
inline bool needs_speed(const Friction &law)
{
  return law.law == "film" || law.law == "speed";
}

/// Coulomb coefficient of the pass.
/// @throws InputError  law "factor", which has no coefficient, or an unknown law
template <class Law, class T> T coulomb_coefficient(const Law &law, const Inlet<T> &in)
{
  if (law.law == "coulomb")
    return T(law.coefficient);
  if (law.law == "speed")
    return speed_friction(law, in.roll_speed);
  if (law.law == "film")
    return film_friction(law, film_thickness(law, in));
  if (law.law == "factor")
    throw InputError(
        "strip.friction.law = \"factor\" has no Coulomb coefficient: this theory needs coulomb, speed or "
        "film; the theory of Hu and Ehmann takes factors (m is about 2 mu p / k)");
  throw InputError("strip.friction.law = \"" + law.law + "\" is not known; coulomb, factor, speed or film");
}
}  // namespace mill::bite
