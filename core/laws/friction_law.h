#pragma once
#include "plain_number.h"
#include <array>
#include <cmath>
#include <string>
#include <vector>

// Friction between roll and strip: everything about a law is written here and in friction_law.cpp, and nowhere
// else. Readers, schema, cache keys, provenance, sensitivities and solvers ask for a law's row or call its
// formulas. A law without a case in one of the switches does not compile.  theory.md 8.7
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"

namespace mill {
enum class FrictionLaw { coulomb, factor, speed, film };

/// A law with its constants; T is double or a number with derivatives.
template <class T> struct FrictionOf {
  FrictionLaw law = FrictionLaw::coulomb;
  T coefficient   = 0;  ///< -, coulomb: mu
  /// Largest friction stress over the shear yield stress k_f/2, for the models that know one; nan: no limit.
  T shear_limit  = 1;  ///< -
  T entry_factor = 0;  ///< -, factor: friction stress over shear yield stress before the neutral point
  T exit_factor  = 0;  ///< -, factor: behind it
  /// speed: mu = scale (at_unit_speed + per_log_speed ln(v / (1 m/s))), v the speed of the roll's surface
  T scale         = 1;  ///< -
  T at_unit_speed = 0;  ///< -
  T per_log_speed = 0;  ///< -, negative: falls with speed
  /// film: mu = mu0 + mu1 exp(-decay h_f), h_f the mean oil film of the bite
  T mu0                = 0;  ///< -
  T mu1                = 0;  ///< -
  T decay              = 0;  ///< 1/m
  T viscosity          = 0;  ///< Pa s, of the oil at the temperature and pressure of the inlet
  T pressure_viscosity = 0;  ///< 1/Pa, gamma of viscosity exp(gamma p)
  T film_factor        = 3;  ///< -, factor of the film law
};
using Friction = FrictionOf<double>;

constexpr std::size_t n_friction_constants = sizeof(Friction) / sizeof(double) - 1;

/// Where the constants stand, in the order of friction_constants(); one that is missing does not compile.
template <class T> std::array<T *, n_friction_constants> places_of_constants(FrictionOf<T> &friction)
{
  auto &[law, coefficient, shear_limit, entry_factor, exit_factor, scale, at_unit_speed, per_log_speed, mu0, mu1,
         decay, viscosity, pressure_viscosity, film_factor] = friction;
  return std::array{&coefficient,   &shear_limit,        &entry_factor, &exit_factor, &scale,
                    &at_unit_speed, &per_log_speed,      &mu0,          &mu1,         &decay,
                    &viscosity,     &pressure_viscosity, &film_factor};
}

/// The same law in numbers of another type.
template <class T> FrictionOf<T> friction_in(Friction friction)
{
  FrictionOf<T> out;
  out.law         = friction.law;
  const auto from = places_of_constants(friction);
  const auto to   = places_of_constants(out);
  for (std::size_t i = 0; i < n_friction_constants; ++i)
    *to[i] = T(*from[i]);
  return out;
}

/// A constant of the laws: its row in a case file, and its name as a number of a pass.
struct FrictionConstant {
  const char *key;
  double Friction::*member;
  const char *unit;             ///< of the case file
  std::array<double, 2> range;  ///< in that unit, both ends allowed
  double fallback;              ///< in that unit
  const char *example, *meaning;
  const char *input;    ///< what else a case calls it: "oil.viscosity"
  const char *name;     ///< in the tables of sensitivities; empty: no number by which a bite is differentiated
  const char *si_unit;  ///< there
};
const std::array<FrictionConstant, n_friction_constants> &friction_constants();

/// What the program must know of a law in addition to its formulas.
struct FrictionRow {
  using Constants = std::vector<double Friction::*>;
  const char *name;   ///< in a case file
  Constants needs;    ///< a case has to give them
  Constants may;      ///< read as well, with their defaults
  Constants number;   ///< those that are "the friction" where a single number is asked for; none: the law has no
                      ///< such number
  bool slides;        ///< has a Coulomb coefficient; else friction stress over shear yield stress is given
  bool needs_speed;   ///< of the roll
  bool follows_bite;  ///< the coefficient depends on the state of the bite, and both are solved together
  bool film;          ///< knows the thickness of an oil film
};
const FrictionRow &row_of(FrictionLaw law);
const std::vector<FrictionLaw> &friction_laws();  ///< all of them
extern const char *const friction_laws_in_words;  ///< what the key `law` means

/// @throws InputError  no law of this name
FrictionLaw friction_law(const std::string &name);
std::string name_of(FrictionLaw law);
bool reads(const Friction &friction, double Friction::*constant);

inline bool slides(const Friction &friction)
{
  return row_of(friction.law).slides;
}
inline bool needs_speed(const Friction &friction)
{
  return row_of(friction.law).needs_speed;
}
inline bool follows_bite(const Friction &friction)
{
  return row_of(friction.law).follows_bite;
}
inline bool has_film(const Friction &friction)
{
  return row_of(friction.law).film;
}
/// True if one number says the friction: a coefficient, or a factor on both sides.
inline bool is_a_number(const Friction &friction)
{
  return !row_of(friction.law).number.empty();
}

/// The law with this number. @throws InputError  it has no single number; says what a map over friction needs
Friction with_number(Friction friction, double number);

/// The friction as a plain number: Coulomb's mu, or the factors as they are.
Friction as_number(const Friction &friction, double mu);

/// Coulomb's mu where the law is that coefficient alone; nan: a pass must give it, or the law has none.
double plain_coefficient(const Friction &friction);

/// What a result calls the friction: the coefficient, or the mean of both factors.
double friction_value(const Friction &friction, double mu);

/// @throws InputError  constants outside what the formulas allow
void check_constants(const Friction &friction);

namespace bite {
/// @throws InputError always: the law has factors where a coefficient is needed
[[noreturn]] void refuse_factors(FrictionLaw law);

/// What the friction laws look at; T is double, complex or a number with derivatives.
template <class T> struct Inlet {
  T roll_speed, entry_speed, exit_speed;  ///< m/s
  T radius;                               ///< m, of the arc
  T arc_length;                           ///< m, line of centres to entry
  T entry_pressure;  ///< Pa, k_fe - sigma_e: what the film has to carry where the strip yields
};

/// Mean oil film of the bite, m, (8.20).  Law "film".  Law is Friction or FrictionOf<T>.
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

/// Coulomb coefficient of a pass, and the film it comes from.
template <class T> struct Coefficient {
  T mu;    ///< -
  T film;  ///< m; nan without a film
};

/// @throws InputError  a law that has no coefficient
template <class Law, class T> Coefficient<T> coefficient_at(const Law &law, const Inlet<T> &in)
{
  const T none(std::nan(""));
  switch (law.law) {
  case FrictionLaw::coulomb:
    return {T(law.coefficient), none};
  case FrictionLaw::speed:
    return {speed_friction(law, in.roll_speed), none};
  case FrictionLaw::film: {
    const T film = film_thickness(law, in);
    return {film_friction(law, film), film};
  }
  case FrictionLaw::factor:
    break;
  }
  refuse_factors(law.law);
}
template <class Law, class T> T coulomb_coefficient(const Law &law, const Inlet<T> &in)
{
  return coefficient_at(law, in).mu;
}

/// A coefficient to start from where the bite is not known yet: that of the roll speed, or of a thick film.
/// @throws InputError  a law that has no coefficient
double starting_coefficient(const Friction &law, double roll_speed);

/// Friction of one pass, its coefficient known: friction stress from pressure p and flow stress k, any units.
/// `side` is +1 before the neutral point, -1 behind it; a T between both where the change is smoothed.
template <class T> struct Traction {
  bool slides  = true;  ///< mu p up to the limit; false: at the limit all along
  bool limited = true;  ///< false: the law knows no limit
  T coefficient;        ///< -, mu
  T entry_factor;       ///< -, limit over the shear yield stress k/2 before the neutral point
  T exit_factor;        ///< -, behind it
};

/// @param number  mu; for a law of factors what is added to both
template <class T> Traction<T> traction_of(const Friction &law, const T &number)
{
  Traction<T> t;
  t.slides  = slides(law);
  t.limited = !t.slides || std::isfinite(law.shear_limit);
  if (t.slides) {
    t.coefficient  = number;
    t.entry_factor = t.exit_factor = T(t.limited ? law.shear_limit : 1.0);
  } else {
    t.coefficient  = T(0.0);
    t.entry_factor = law.entry_factor + number;
    t.exit_factor  = law.exit_factor + number;
  }
  return t;
}

template <class T> T sliding_traction(const Traction<T> &law, const T &p)
{
  return law.coefficient * p;
}
template <class T> T largest_traction(const Traction<T> &law, const T &k, const int side)
{
  return 0.5 * k * (side > 0 ? law.entry_factor : law.exit_factor);
}
template <class T> T largest_traction(const Traction<T> &law, const T &k, const T &side)
{
  return 0.5 * k *
         (0.5 * (law.entry_factor + law.exit_factor) + 0.5 * side * (law.entry_factor - law.exit_factor));
}

/// True where the pressure would ask for more than the limit, or the law knows nothing else.
template <class T, class Side> bool at_limit(const Traction<T> &law, const T &p, const T &k, const Side &side)
{
  return !law.slides ||
         (law.limited && value_of(sliding_traction(law, p)) > value_of(largest_traction(law, k, side)));
}

/// Friction stress, at most; where strip and roll stick it is less.
template <class T, class Side> T traction_limit(const Traction<T> &law, const T &p, const T &k, const Side &side)
{
  return at_limit(law, p, k, side) ? largest_traction(law, k, side) : sliding_traction(law, p);
}
}  // namespace bite

template <class Io> void each_member(Io &&io, const Friction &record)
{
  io("law", name_of(record.law));
  for (const FrictionConstant &constant : friction_constants())
    io(constant.key, record.*constant.member);
}
}  // namespace mill
#pragma GCC diagnostic pop
