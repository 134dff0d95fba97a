#include "core/model/case.h"
#include "dynamics/chatter/sensitivity.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

// What moves friction and critical speed of condition 2 on stand D.
namespace mill::verify {
std::vector<Case> chatter_map_cases();

namespace {
using namespace dynamics;
using bite::PassNumber;
using bite::RollBite;
/// A stand with its bite, one input of which can be scaled.
struct Rolling {
  ChatterStandModel stand;
  RollBite bite;
};
using Scaled = std::function<Rolling(double)>;

Rolling condition_2()
{
  return {chatter_stand("D"), film_bite(2, 18.2)};
}

Scaled by_numbers(const std::vector<PassNumber> &numbers)
{
  return [=](const double factor) {
    Rolling r = condition_2();
    for (const PassNumber number : numbers)
      r.bite = with_number_scaled(r.bite, number, factor);
    return r;
  };
}

Scaled by_stand(void (*change)(SixMasses &, double))
{
  return [=](const double factor) {
    SixMasses six = six_masses("D");
    change(six, factor);
    return Rolling{chatter_stand(six), film_bite(2, 18.2)};
  };
}

/// Critical speed next to that of the unchanged stand: the search needs no wide range then.
double critical(const Rolling &r, const Linearisation scheme = Linearisation::sequential, const double from = 16.2,
                const double to = 20.2)
{
  SpeedRange range;
  range.from = from;
  range.to   = to;
  range.step = 2;
  return critical_speed(r.stand, r.bite, scheme, range).speed;
}

double friction(const Rolling &r)
{
  return working_point(r.bite, r.bite.roll_speed, Linearisation::sequential).state.friction;
}

/// ln(f(1 + step)/f(1 - step)) over the same of the input.
double log_slope(const std::function<double(double)> &f, const double step)
{
  return std::log(f(1 + step) / f(1 - step)) / std::log((1 + step) / (1 - step));
}

SensitivityTable table_of(const Linearisation scheme, const double change)
{
  const SixMasses six = six_masses("D");
  SensitivityRequest request;
  request.scheme        = scheme;
  request.working_speed = 18.2;
  request.change        = change;
  request.threads       = 1;
  return chatter_sensitivities(chatter_stand(six), six_mass_numbers(six.mass, six.stiffness, six.damping),
                               film_bite(2, 18.2), request);
}

const ChatterSensitivity &row(const SensitivityTable &table, const std::string &key)
{
  return *std::find_if(table.inputs.begin(), table.inputs.end(), [&](const auto &s) { return s.key == key; });
}

// CH-21, friction
std::vector<Check> friction_slopes()
{
  const SensitivityTable table = table_of(Linearisation::sequential, 0);
  struct Entry {
    const char *name, *key;
    PassNumber number;
    double slope;
  };
  const Entry entries[]{
      {"entry thickness", "condition.entry_thickness", PassNumber::entry_thickness, 3.3966154858316253},
      {"exit thickness", "condition.exit_thickness", PassNumber::exit_thickness, -2.5807052107436546},
      {"viscosity", "oil.viscosity", PassNumber::viscosity, -1.116817632341523},
      {"pressure coefficient", "oil.pressure_viscosity", PassNumber::pressure_viscosity, -1.1166977021501228},
      {"speed", "condition.speed", PassNumber::roll_speed, -1.116817632341523},
      {"entry tension", "condition.entry_tension", PassNumber::entry_tension, 0.08610547091153528},
      {"exit tension", "condition.exit_tension", PassNumber::exit_tension, 0.018199304039760347}};
  std::vector<Check> checks;
  for (const auto &[name, key, number, slope] : entries) {
    const Scaled scaled = by_numbers({number});
    const auto mu       = [&](const double factor) { return friction(scaled(factor)); };
    checks.push_back(absolute(std::string(name) + ", over +-1 %", "-", log_slope(mu, 0.01), slope, 1e-8));
    // Two differences without their error of second order.
    const double exact   = row(table, key).friction;
    const double refined = (4 * log_slope(mu, 1e-3) - log_slope(mu, 2e-3)) / 3;
    checks.push_back(absolute(std::string(name) + ", exact", "-", exact, refined, 1e-8));
  }
  checks.push_back(at_most("flow stress, exact", "-", row(table, "strip.flow_stress.k").friction, 0));
  checks.push_back(at_most("roll diameter, exact", "-", row(table, "work_roll.diameter").friction, 0));
  return checks;
}

struct SpeedEntry {
  const char *name, *key;
  Scaled scaled;
  double slope;
};

// CH-21, critical speed
std::vector<Check> speed_slopes()
{
  using N = PassNumber;
  struct Entry : SpeedEntry {
    double lowered, raised;
  };
  const Entry entries[]{
      {{"entry thickness", "condition.entry_thickness", by_numbers({N::entry_thickness}), -0.16602937800493242},
       0.051810714757689835,
       -0.0012212389830991155},
      {{"exit thickness", "condition.exit_thickness", by_numbers({N::exit_thickness}), 0.20701029029527865},
       -0.003076065368341818,
       0.04555357638046398},
      {{"viscosity", "oil.viscosity", by_numbers({N::viscosity}), -0.26938348159049597},
       0.029304805721548366,
       -0.02497783004111398},
      {{"pressure coefficient", "oil.pressure_viscosity", by_numbers({N::pressure_viscosity}),
        -0.26918493474558386},
       0.02926566457765345,
       -0.024966831811430445},
      {{"entry tension", "condition.entry_tension", by_numbers({N::entry_tension}), -0.1379753263749745},
       0.013680143593747696,
       -0.013931115364452573},
      {{"exit tension", "condition.exit_tension", by_numbers({N::exit_tension}), -0.04119458064401969},
       0.0038862149958087677,
       -0.004342834011505703},
      {{"both tensions", "condition.tensions", by_numbers({N::entry_tension, N::exit_tension}),
        -0.17916981441675772},
       0.01783359747769886,
       -0.018005129206224324}};
  const SensitivityTable table = table_of(Linearisation::sequential, 0.1);
  std::vector<Check> checks;
  for (const Entry &e : entries) {
    const std::string name      = e.name;
    const ChatterSensitivity &s = row(table, e.key);
    const auto v                = [&](const double factor) { return critical(e.scaled(factor)); };
    checks.push_back(absolute(name + ", over +-1 %", "-", log_slope(v, 0.01), e.slope, 1e-7));
    checks.push_back(absolute(name + ", exact", "-", s.critical_speed, e.slope, 1e-3));
    checks.push_back(absolute(name + ", change at -10 %", "-", s.lowered.critical_speed, e.lowered, 1e-7));
    checks.push_back(absolute(name + ", change at +10 %", "-", s.raised.critical_speed, e.raised, 1e-7));
  }
  checks.push_back(
      {"flow stress, exact", "-", row(table, "strip.flow_stress.k").critical_speed, 0, 0, Judged::at_least});
  checks.push_back(
      {"roll diameter, exact", "-", row(table, "work_roll.diameter").critical_speed, 0, 0, Judged::at_least});
  double turning = 0;  // both thicknesses and nothing else
  for (const ChatterSensitivity &s : table.inputs)
    turning += !s.monotone;
  checks.push_back(absolute("inputs that do not go one way", "-", turning, 2, 0));
  checks.push_back(absolute(
      "of them thicknesses", "-",
      !row(table, "condition.entry_thickness").monotone + !row(table, "condition.exit_thickness").monotone, 2, 0));
  return checks;
}

std::vector<Check> leverage()
{
  using N = PassNumber;
  const SpeedEntry entries[]{
      {"both distances", "stand.distances", by_stand([](SixMasses &s, const double f) { s.distance *= f; }),
       0.35104532063744015},
      {"distance before", "stand.entry_distance",
       [](const double f) {
         Rolling r = condition_2();
         r.stand.entry_distance *= f;
         return r;
       },
       0.30339814521909236},
      {"distance behind", "stand.exit_distance",
       [](const double f) {
         Rolling r = condition_2();
         r.stand.exit_distance *= f;
         return r;
       },
       0.04765067167964185},
      {"all dampings", "stand.dampings", by_stand([](SixMasses &s, const double f) {
         for (double &c : s.damping)
           c *= f;
       }),
       0.03466160106732557},
      {"damping c0", "stand.dampings[0]", by_stand([](SixMasses &s, const double f) { s.damping[0] *= f; }),
       0.00080561836274041},
      {"damping c5", "stand.dampings[5]", by_stand([](SixMasses &s, const double f) { s.damping[5] *= f; }),
       0.014274246734670416},
      {"mass m1", "stand.masses[1]", by_stand([](SixMasses &s, const double f) { s.mass[1] *= f; }),
       -0.036920453829314394},
      {"mass m4", "stand.masses[4]", by_stand([](SixMasses &s, const double f) { s.mass[4] *= f; }),
       -0.2718625276001231},
      {"mass m5", "stand.masses[5]", by_stand([](SixMasses &s, const double f) { s.mass[5] *= f; }),
       -0.021590319591820305},
      {"modulus of the rolls", "steel.youngs_modulus", by_numbers({N::youngs_modulus}), -0.1183857512510176},
      {"initial thickness", "strip.initial_thickness", by_numbers({N::initial_thickness}), 0.06276838512974171},
      {"friction", "oil.friction", by_numbers({N::mu0, N::mu1}), 0.21829964995222606}};
  const SensitivityTable table = table_of(Linearisation::sequential, 0);
  std::vector<Check> checks;
  for (const auto &[name, key, scaled, slope] : entries) {
    const auto v = [&, &f = scaled](const double factor) { return critical(f(factor)); };
    checks.push_back(absolute(std::string(name) + ", over +-2 %", "-", log_slope(v, 0.02), slope, 1e-7));
    checks.push_back(absolute(std::string(name) + ", exact", "-", row(table, key).critical_speed, slope, 1e-3));
  }
  return checks;
}

std::vector<Check> exact_slopes()
{
  const SixMasses six = six_masses("D");
  const auto numbers  = six_mass_numbers(six.mass, six.stiffness, six.damping);
  std::vector<Check> checks;
  const auto largest = [&](const SensitivityTable &table, const Linearisation scheme, const bool of_bite) {
    double deviation = 0;
    const auto look  = [&](const std::string &key, const Scaled &scaled) {
      const auto v = [&](const double f) {
        return critical(scaled(f), scheme, table.critical_speed - 0.5, table.critical_speed + 0.5);
      };
      const double refined = (4 * log_slope(v, 2e-3) - log_slope(v, 4e-3)) / 3;
      deviation            = std::max(deviation, std::abs(row(table, key).critical_speed - refined));
    };
    if (of_bite) {
      for (const PassNumber number : numbers_of(film_bite(2, 18.2)))
        if (number != PassNumber::roll_speed)
          look(name_of(number).key, by_numbers({number}));
    } else
      for (const StructureNumber &number : numbers)
        look(number.key, [&](const double f) {
          Rolling r         = condition_2();
          r.stand.structure = number.scaled(f);
          return r;
        });
    return deviation;
  };
  const std::pair<const char *, Linearisation> schemes[]{{"in sequence", Linearisation::sequential},
                                                         {"implicit", Linearisation::implicit},
                                                         {"friction frozen", Linearisation::frozen_friction}};
  for (const auto &[name, scheme] : schemes) {
    const SensitivityTable table = table_of(scheme, 0);
    checks.push_back(at_most(std::string(name) + ", inputs of the bite", "-", largest(table, scheme, true), 1e-7));
    checks.push_back(
        at_most(std::string(name) + ", masses, springs, dampers", "-", largest(table, scheme, false), 1e-8));
  }
  const SensitivityTable table = table_of(Linearisation::sequential, 0);
  const auto both =
      row(table, "stand.entry_distance").critical_speed + row(table, "stand.exit_distance").critical_speed;
  checks.push_back(absolute("modulus of the strip against both distances", "-",
                            row(table, "strip.youngs_modulus").critical_speed, -both, 1e-12));
  return checks;
}

// Friction of the working point as Coulomb's constant.
std::vector<Check> held_friction()
{
  const double mu = friction(condition_2());
  const auto held = [&](const Scaled &scaled) {
    return [=](const double factor) {
      Rolling r                         = scaled(factor);
      r.bite.strip.friction             = Friction{};
      r.bite.strip.friction.coefficient = mu;
      return critical(r, Linearisation::sequential, 15.2, 19.2);
    };
  };
  const SpeedEntry entries[]{
      {"entry thickness", "condition.entry_thickness", by_numbers({PassNumber::entry_thickness}),
       -1.3473018881450243},
      {"exit thickness", "condition.exit_thickness", by_numbers({PassNumber::exit_thickness}), 1.157509231027809},
      {"entry tension", "condition.entry_tension", by_numbers({PassNumber::entry_tension}), -0.23872503042083879}};
  const SensitivityTable table = table_of(Linearisation::sequential, 0);
  std::vector<Check> checks;
  for (const auto &[name, key, scaled, slope] : entries) {
    checks.push_back(
        absolute(std::string(name) + ", over +-1 %", "-", log_slope(held(scaled), 0.01), slope, 1e-7));
    checks.push_back(absolute(std::string(name) + ", exact", "-", row(table, key).critical_speed_at_held_friction,
                              slope, 1e-3));
  }
  return checks;
}

}  // namespace

std::vector<Case> chatter_sensitivity_cases()
{
  const std::string stand = std::string(chatter_stands) + "Condition 2 on stand D at 18.2 m/s. ";
  const std::string liu   = chatter_source;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("chatter-friction-slopes", "regression",
      stand +
          "d ln mu/d ln p: over +-1 % as the reference takes it, and exact, by differentiating the steady bite "
          "with R' following its force, against two differences extrapolated.",
      liu + "slope.mu.*; differences of states; signs of flow stress and roll as published",
      "1e-8: states solved to 1e-13 over a span of 2 %; extrapolated differences are good to the fourth power of "
      "the step.",
      friction_slopes);
  add("chatter-speed-slopes", "regression",
      stand +
          "d ln v_crit/d ln p over +-1 % and changes at +-10 % by searching again, and the exact slopes, which "
          "the span of the reference must explain. Both thicknesses turn within +-10 %. The level of v_crit is "
          "fitted, so these are regression values.",
      liu + "slope.v_crit.*; signs of flow stress and roll as published",
      "1e-7 where the same difference is taken: searches to 1e-10 m/s; 1e-3 between exact slope and a span of 2 "
      "%: "
      "its curvature is 8e-4 for the entry thickness.",
      speed_slopes);
  add("chatter-leverage", "regression",
      stand + "d ln v_crit/d ln p by the assumed inputs of the stand over +-2 % and exact. Regression values: the "
              "distance is fitted.",
      liu + "leverage.v_crit", "1e-7: the same differences; 1e-3: the span of 4 %.", leverage);
  add("chatter-exact-slopes", "verification",
      stand +
          "Exact slopes of the critical speed, from both eigenvectors and the second derivatives of the bite, "
          "against extrapolated differences of searches: largest deviation over 19 inputs of the bite and 19 of "
          "the structure in three linearisations.",
      "differences of critical speeds over 0.2 and 0.4 %, extrapolated; E/L is one number",
      "1e-7 and 1e-8: searches to 1e-10 m/s over 0.07 m/s, fourth power of the step where the thicknesses curve "
      "most.",
      exact_slopes);
  add("chatter-held-friction", "regression",
      stand +
          "d ln v_crit/d ln p with friction held: Coulomb's constant of the working point. What is missing from "
          "the slopes of the film is the way over the friction.",
      liu + "slope.v_crit.constant_friction.*", "1e-7: the same differences; 1e-3: the span of 2 %.",
      held_friction);
  for (Case &c : chatter_map_cases())
    cases.push_back(std::move(c));
  return cases;
}
}  // namespace mill::verify
