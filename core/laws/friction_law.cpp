#include "friction_law.h"
#include "refuse_input.h"
#include "scaled_friction.h"
#include <algorithm>

#pragma GCC diagnostic error "-Wswitch"

namespace mill {
namespace {
using FrictionConstants = Friction;

// Lists by name: nested ones of different lengths crash clang-format 14 (AlignArrayOfStructures).
const FrictionRow::Constants no_constants, one_number{&FrictionConstants::coefficient},
    both_factors{&FrictionConstants::entry_factor, &FrictionConstants::exit_factor};
const FrictionRow::Constants speed_needs{&FrictionConstants::at_unit_speed},
    speed_may{&FrictionConstants::scale, &FrictionConstants::per_log_speed};
const FrictionRow::Constants film_needs{&FrictionConstants::mu0, &FrictionConstants::mu1,
                                        &FrictionConstants::decay, &FrictionConstants::viscosity,
                                        &FrictionConstants::pressure_viscosity};
const FrictionRow::Constants film_may{&FrictionConstants::film_factor};

// name, needs, may, number; slides, needs_speed, follows_bite, film
const FrictionRow coulomb{"coulomb", one_number, no_constants, one_number, true, false, false, false};
const FrictionRow factor{"factor", both_factors, no_constants, both_factors, false, false, false, false};
const FrictionRow speed{"speed", speed_needs, speed_may, no_constants, true, true, false, false};
const FrictionRow film{"film", film_needs, film_may, no_constants, true, true, true, true};

// The row; null for a value that is not a law, so that all laws can be counted.
const FrictionRow *find_row(const FrictionLaw law)
{
  switch (law) {
  case FrictionLaw::coulomb:
    return &coulomb;
  case FrictionLaw::factor:
    return &factor;
  case FrictionLaw::speed:
    return &speed;
  case FrictionLaw::film:
    return &film;
  }
  return nullptr;
}

// "coulomb, speed or film", of the laws that are wanted.
template <class Wanted> std::string listed(const Wanted &wanted, const std::string &quote = "")
{
  std::vector<std::string> names;
  for (const FrictionLaw law : friction_laws())
    if (wanted(row_of(law)))
      names.push_back(quote + name_of(law) + quote);
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

bool holds(const FrictionRow::Constants &list, double Friction::*const constant)
{
  return std::find(list.begin(), list.end(), constant) != list.end();
}
}  // namespace

const char *const friction_laws_in_words =
    "friction stress mu p, or m times the shear yield stress (factor); mu a number, by speed, or by oil film";

const std::array<FrictionConstant, n_friction_constants> &friction_constants()
{
  // Meaning and names on lines of their own.
  // clang-format off
  static const std::array rows{
    FrictionConstant{"coefficient", &FrictionConstants::coefficient, "1", {0, 1}, 0, "0.05",
                     "mu of coulomb",
                     "strip.friction", "friction coefficient", "1"},
    FrictionConstant{"shear_limit", &FrictionConstants::shear_limit, "1", {0.01, 1}, 1, "1",
                     "largest friction stress over the shear yield stress, for the models that know one",
                     "", "", "1"},
    FrictionConstant{"entry_factor", &FrictionConstants::entry_factor, "1", {0, 1}, 0, "0.1",
                     "m before the neutral point, law factor",
                     "", "", "1"},
    FrictionConstant{"exit_factor", &FrictionConstants::exit_factor, "1", {0, 1}, 0, "0.1",
                     "m behind the neutral point, law factor",
                     "", "", "1"},
    FrictionConstant{"scale", &FrictionConstants::scale, "1", {0, 100}, 1, "1",
                     "mu = scale (at_unit_speed + per_log_speed ln(v / (1 m/s))), law speed",
                     "strip.friction.scale", "friction, factor on the speed law", "1"},
    FrictionConstant{"at_unit_speed", &FrictionConstants::at_unit_speed, "1", {0, 1}, 0, "0.066723",
                     "law speed",
                     "strip.friction.at_unit_speed", "friction at 1 m/s", "1"},
    FrictionConstant{"per_log_speed", &FrictionConstants::per_log_speed, "1", {-1, 1}, 0, "-0.00662",
                     "law speed; negative where friction falls with speed",
                     "strip.friction.per_log_speed", "friction by the logarithm of the speed", "1"},
    FrictionConstant{"mu0", &FrictionConstants::mu0, "1", {0, 1}, 0, "0.012",
                     "mu = mu0 + mu1 exp(-decay film thickness), law film",
                     "oil.friction.mu0", "friction under a thick film, mu0", "1"},
    FrictionConstant{"mu1", &FrictionConstants::mu1, "1", {0, 1}, 0, "0.142",
                     "law film",
                     "oil.friction.mu1", "friction that a film removes, mu1", "1"},
    FrictionConstant{"decay", &FrictionConstants::decay, "1/um", {0, 1000}, 0, "2.43 1/um",
                     "law film",
                     "oil.friction.decay", "decay of the friction with the film", "1/m"},
    FrictionConstant{"viscosity", &FrictionConstants::viscosity, "Pa s", {0, 100}, 0, "0.005 Pa s",
                     "of the oil at the inlet of the bite, law film",
                     "oil.viscosity", "viscosity of the oil", "Pa s"},
    FrictionConstant{"pressure_viscosity", &FrictionConstants::pressure_viscosity, "1/Pa", {0, 1e-6}, 0, "2e-8 1/Pa",
                     "exponent of the oil's viscosity over pressure, law film",
                     "oil.pressure_viscosity", "pressure coefficient of the viscosity", "1/Pa"},
    FrictionConstant{"film_factor", &FrictionConstants::film_factor, "1", {0.01, 100}, 3, "3",
                     "factor of the inlet film, law film; 3 in the source of the law, 3/2 by Wilson and Walowit",
                     "oil.film_factor", "factor of the film law", "1"}
  };
  // clang-format on
  return rows;
}

const FrictionRow &row_of(const FrictionLaw law)
{
  return *find_row(law);
}

const std::vector<FrictionLaw> &friction_laws()
{
  static const std::vector<FrictionLaw> laws = [] {
    std::vector<FrictionLaw> all;
    for (int i = 0; find_row(FrictionLaw(i)); ++i)
      all.push_back(FrictionLaw(i));
    return all;
  }();
  return laws;
}

FrictionLaw friction_law(const std::string &name)
{
  for (const FrictionLaw law : friction_laws())
    if (name == row_of(law).name)
      return law;
  refuse_input("strip.friction.law = \"" + name + "\" is not known; " +
               listed([](const FrictionRow &) { return true; }));
}

std::string name_of(const FrictionLaw law)
{
  return row_of(law).name;
}

bool reads(const Friction &friction, double Friction::*const constant)
{
  const FrictionRow &row = row_of(friction.law);
  return holds(row.needs, constant) || holds(row.may, constant);
}

Friction with_number(Friction friction, const double number)
{
  if (!is_a_number(friction))
    refuse_input("a map over friction needs the law " +
                 listed([](const FrictionRow &row) { return !row.number.empty(); }, "\"") + ": the law \"" +
                 name_of(friction.law) + "\" has no single number; take the roll speed instead");
  for (const auto constant : row_of(friction.law).number)
    friction.*constant = number;
  return friction;
}

Friction as_number(const Friction &friction, const double mu)
{
  if (!slides(friction))
    return friction;
  Friction plain    = friction;
  plain.law         = FrictionLaw::coulomb;
  plain.coefficient = mu;
  return plain;
}

Friction scaled(Friction friction, const double factor)
{
  switch (friction.law) {
  case FrictionLaw::coulomb:
    friction.coefficient *= factor;
    break;
  case FrictionLaw::factor:
    friction.entry_factor *= factor;
    friction.exit_factor *= factor;
    break;
  case FrictionLaw::speed:
    friction.scale *= factor;
    break;
  case FrictionLaw::film:
    friction.mu0 *= factor;
    friction.mu1 *= factor;
    break;
  }
  return friction;
}

double own_scale(const Friction &friction)
{
  return reads(friction, &Friction::scale) ? friction.scale : 1;
}

bool is_zero(const Friction &friction)
{
  const Friction other = scaled(friction, 2);
  for (const FrictionConstant &constant : friction_constants())
    if (other.*constant.member != friction.*constant.member)
      return false;
  return true;
}

double plain_coefficient(const Friction &friction)
{
  const bool plain = slides(friction) && !needs_speed(friction) && !follows_bite(friction);
  return plain ? bite::coulomb_coefficient(friction, bite::Inlet<double>{}) : NAN;
}

double friction_value(const Friction &friction, const double mu)
{
  return slides(friction) ? mu : 0.5 * (friction.entry_factor + friction.exit_factor);
}

void check_constants(const Friction &friction)
{
  switch (friction.law) {
  case FrictionLaw::film:
    if (!(friction.viscosity > 0 && friction.pressure_viscosity > 0 && friction.film_factor > 0))
      refuse_input("strip.friction: a film needs a positive viscosity, pressure_viscosity and film_factor");
    if (!(friction.mu0 > 0 && friction.mu1 >= 0 && friction.decay >= 0))
      refuse_input("strip.friction: the film law needs mu0 > 0, mu1 >= 0 and decay >= 0");
    break;
  case FrictionLaw::coulomb:
  case FrictionLaw::factor:
  case FrictionLaw::speed:
    break;
  }
}

double bite::starting_coefficient(const Friction &law, const double roll_speed)
{
  return has_film(law) ? law.mu0 : coulomb_coefficient(law, Inlet<double>{roll_speed, 0, 0, 1, 1, 1});
}

void bite::refuse_factors(const FrictionLaw law)
{
  refuse_input("strip.friction.law = \"" + name_of(law) + "\" has no Coulomb coefficient: this theory needs " +
               listed([](const FrictionRow &row) { return row.slides; }) +
               "; the theory of Hu and Ehmann takes factors (m is about 2 mu p / k)");
}
}  // namespace mill
