#include "bite/linear/linear_sensitivity.h"
#include <cmath>

// The numbers of a pass by name.
namespace mill::bite {
namespace {
/// Where a number stands; none for the factor on the flow stress.
double *place_of(RollBite &bite, const PassNumber number)
{
  Strip &s                             = bite.strip;
  FlowStress &k                        = s.flow_stress;
  Friction &f                          = s.friction;
  double *const places[n_pass_numbers] = {&s.entry_thickness,
                                          &s.exit_thickness,
                                          &s.entry_tension,
                                          &s.exit_tension,
                                          &s.width,
                                          &bite.roll_speed,
                                          &bite.roll_radius,
                                          &bite.roll.youngs_modulus,
                                          &bite.roll.poisson_ratio,
                                          nullptr,
                                          &k.k,
                                          &k.eps0,
                                          &k.n,
                                          &k.k0,
                                          &s.initial_thickness,
                                          &f.coefficient,
                                          &f.scale,
                                          &f.at_unit_speed,
                                          &f.per_log_speed,
                                          &f.mu0,
                                          &f.mu1,
                                          &f.decay,
                                          &f.viscosity,
                                          &f.pressure_viscosity,
                                          &f.film_factor};
  return places[int(number)];
}

bool is_read(const RollBite &bite, const PassNumber number)
{
  const std::string &hardening = bite.strip.flow_stress.law, &friction = bite.strip.friction.law;
  switch (number) {
  case PassNumber::stress:
    return hardening != "table";
  case PassNumber::pre_strain:
    return hardening == "swift" || hardening == "reduction-power";
  case PassNumber::exponent:
    return hardening != "table" && hardening != "constant";
  case PassNumber::initial_stress:
    return hardening == "ludwik" || hardening == "voce";
  case PassNumber::initial_thickness:
    return hardening != "constant";
  case PassNumber::friction:
    return friction == "coulomb";
  case PassNumber::friction_scale:
  case PassNumber::at_unit_speed:
  case PassNumber::per_log_speed:
    return friction == "speed";
  case PassNumber::mu0:
  case PassNumber::mu1:
  case PassNumber::decay:
  case PassNumber::viscosity:
  case PassNumber::pressure_viscosity:
  case PassNumber::film_factor:
    return friction == "film";
  default:
    return true;
  }
}
}  // namespace

double value_of(const RollBite &bite, const PassNumber number)
{
  RollBite copy       = bite;
  const double *place = place_of(copy, number);
  return place ? *place : 1;
}

std::vector<PassNumber> numbers_of(const RollBite &bite)
{
  std::vector<PassNumber> numbers;
  for (int i = 0; i < n_pass_numbers; ++i) {
    const auto number  = PassNumber(i);
    const double value = value_of(bite, number);
    if (is_read(bite, number) && value != 0 && !std::isnan(value))
      numbers.push_back(number);
  }
  return numbers;
}

RollBite with_number_scaled(RollBite bite, const PassNumber number, const double factor)
{
  if (double *place = place_of(bite, number)) {
    *place *= factor;
    return bite;
  }
  FlowStress &law = bite.strip.flow_stress;
  law.k *= factor;
  law.k0 *= factor;
  for (auto &row : law.table)
    row[1] *= factor;
  return bite;
}

PassNumberName name_of(const PassNumber number)
{
  static const PassNumberName names[n_pass_numbers] = {
      {"condition.entry_thickness",    "entry thickness",                        "m"   },
      {"condition.exit_thickness",     "exit thickness",                         "m"   },
      {"condition.entry_tension",      "entry tension",                          "Pa"  },
      {"condition.exit_tension",       "exit tension",                           "Pa"  },
      {"condition.width",              "strip width",                            "m"   },
      {"condition.speed",              "roll speed",                             "m/s" },
      {"work_roll.diameter",           "work roll diameter",                     "m"   },
      {"steel.youngs_modulus",         "Young's modulus of the rolls",           "Pa"  },
      {"steel.poisson_ratio",          "Poisson's ratio of the rolls",           "1"   },
      {"strip.flow_stress",            "flow stress as a whole",                 "1"   },
      {"strip.flow_stress.k",          "flow stress, k",                         "Pa"  },
      {"strip.flow_stress.eps0",       "flow stress, eps0",                      "1"   },
      {"strip.flow_stress.n",          "flow stress, n",                         "1"   },
      {"strip.flow_stress.k0",         "flow stress, k0",                        "Pa"  },
      {"strip.initial_thickness",      "thickness before the first stand",       "m"   },
      {"strip.friction",               "friction coefficient",                   "1"   },
      {"strip.friction.scale",         "friction, factor on the speed law",      "1"   },
      {"strip.friction.at_unit_speed", "friction at 1 m/s",                      "1"   },
      {"strip.friction.per_log_speed", "friction by the logarithm of the speed", "1"   },
      {"oil.friction.mu0",             "friction under a thick film, mu0",       "1"   },
      {"oil.friction.mu1",             "friction that a film takes away, mu1",   "1"   },
      {"oil.friction.decay",           "decay of the friction with the film",    "1/m" },
      {"oil.viscosity",                "viscosity of the oil",                   "Pa s"},
      {"oil.pressure_viscosity",       "pressure coefficient of the viscosity",  "1/Pa"},
      {"oil.film_factor",              "factor of the film law",                 "1"   }
  };
  return names[int(number)];
}
}  // namespace mill::bite
