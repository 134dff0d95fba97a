#include "core/base/errors.h"
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/slab_bite.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>

// Roll bite by the theory of Bland and Ford: film, moving gap, coefficients, K4.
namespace mill::verify {
std::vector<Case> cluster_slab_cases();
std::vector<Case> film_coefficient_cases();

namespace {
using namespace bite;

// CH-01
std::vector<Check> film_steady()
{
  const double table[2][10] = {
      {8257344.925615327, 0.023968189622223662, 0.5424180615984966, 1.0179320133299352e-06, 0.010071354304110191,
       0.0032894652627086063, 14.718188147365103, 19.563788822641992, 763017137.5198973, 781358287.9541008},
      {8736293.890034175, 0.02832038583977992, 0.5262338200786073, 8.902930313585982e-07, 0.01056227105582245,
       0.003224610191225185, 13.765554730947603, 18.82326288165972, 759569726.7752361, 780498377.6549077}};
  std::vector<Check> checks;
  int i = 0;
  for (const auto &[name, bite, s] : working_conditions()) {
    const double *r = table[i++];
    checks.push_back(relative(name + "force", "kN", s.force / 1e3, r[0] / 1e3, 1e-8));
    checks.push_back(relative(name + "friction", "-", s.friction, r[1], 1e-8));
    checks.push_back(relative(name + "R'", "mm", s.flattened_radius * 1e3, r[2] * 1e3, 1e-8));
    checks.push_back(relative(name + "film", "um", s.film_thickness * 1e6, r[3] * 1e6, 1e-8));
    checks.push_back(relative(name + "arc", "mm", s.arc_length * 1e3, r[4] * 1e3, 1e-8));
    checks.push_back(relative(name + "neutral point", "mm", s.neutral_position * 1e3, r[5] * 1e3, 1e-8));
    checks.push_back(relative(name + "entry speed", "m/s", s.entry_speed, r[6], 1e-8));
    checks.push_back(relative(name + "exit speed", "m/s", s.exit_speed, r[7], 1e-8));
    checks.push_back(relative(name + "k_f at the entry", "MPa", s.entry_flow_stress / 1e6, r[8] / 1e6, 1e-8));
    checks.push_back(relative(name + "k_f at the exit", "MPa", s.exit_flow_stress / 1e6, r[9] / 1e6, 1e-8));
  }
  const double trend[8][3] = {
      {5, 22743469.452606227, 0.0770184639197065},    {10, 12121328.554802494, 0.050967252767000204},
      {15, 9538174.736191263, 0.03493853578237074},   {18, 8776325.15939798, 0.028671670597620064},
      {18.2, 8736293.890034175, 0.02832038583977992}, {18.4, 8697337.256368782, 0.027976456267518646},
      {20, 8420175.822830899, 0.02547199031830459},   {25, 7834189.718455815, 0.01989372060158044}};
  double force = 0, friction = 0;
  for (const auto &row : trend) {
    const BiteState s = solved(film_bite(2, row[0]));
    force             = std::max(force, std::abs(s.force / row[1] - 1));
    friction          = std::max(friction, std::abs(s.friction / row[2] - 1));
  }
  checks.push_back(at_most("5..25 m/s: largest deviation of the force", "-", force, 1e-8));
  checks.push_back(at_most("5..25 m/s: largest deviation of the friction", "-", friction, 1e-8));
  RollBite half                   = film_bite(2, 18.2);
  half.strip.friction.film_factor = 1.5;
  checks.push_back(
      relative("friction with film factor 3/2", "-", solved(half).friction, 0.05484147372355079, 1e-8));
  return checks;
}

// CH-02: one loop over film, speeds, force and radius together, no Newton.
std::vector<Check> film_single_loop()
{
  std::vector<Check> checks;
  for (const auto &[name, bite, s] : working_conditions()) {
    double R = 1.7 * bite.roll_radius, v = bite.roll_speed * 0.7, force = 0, mu = 0;
    for (int pass = 0; pass < 200; ++pass) {
      const auto in = pass_inputs<double>(bite, R);
      const auto c  = bland_ford_contact(bite.strip, in, v);
      const auto F  = bland_ford_force(bite.strip, in, c, even_rules(16));
      force         = bite.strip.width * (F.entry + F.exit);
      mu            = c.friction;
      v             = c.entry_speed;
      R             = hitchcock_radius(bite, force);
    }
    checks.push_back(relative(name + "force, nested loops against one", "kN", s.force / 1e3, force / 1e3, 1e-9));
    checks.push_back(relative(name + "friction, nested loops against one", "-", s.friction, mu, 1e-9));
  }
  return checks;
}

// CH-03, CH-04
std::vector<Check> film_slab_equation()
{
  const double full[2][2] = {{8095191.5114741465, 0.003003188486910883},
                             {8508435.325845541, 0.002932440016814648}};
  std::vector<Check> checks;
  int i = 0;
  for (const auto &[name, bite, s] : working_conditions()) {
    const SlabIntegral integral = integrate_slab(bite, s.flattened_radius, s.friction, false);
    const SlabIntegral karman   = integrate_slab(bite, s.flattened_radius, s.friction, true);
    checks.push_back(
        relative(name + "closed form against its own equation", "kN", s.force / 1e3, integral.force / 1e3, 1e-9));
    checks.push_back(relative(name + "neutral point likewise", "mm", s.neutral_position * 1e3,
                              integral.neutral_position * 1e3, 1e-9));
    checks.push_back(relative(name + "full slab equation", "kN", karman.force / 1e3, full[i][0] / 1e3, 1e-8));
    checks.push_back(
        relative(name + "full, neutral point", "mm", karman.neutral_position * 1e3, full[i][1] * 1e3, 1e-6));
    checks.push_back(reported(name + "Bland-Ford over the full equation", "-", s.force / karman.force, 1));
    ++i;
  }
  return checks;
}

// CH-05
std::vector<Check> moving_gap()
{
  const double table[2][6] = {
      {0.02, 0.000280490398341936, 13.984355507351173, 18.76120620132937, 8432537.007236928, 0.027942559533988356},
      {-0.02, -0.00027857835274360936, 13.5430729277914, 18.889975294057706, 9045148.024441449,
       0.02871286267553898}};
  RollBite bite    = film_bite(2, 18.2);
  bite.roll_radius = solved(bite).flattened_radius;  // of the steady state
  std::vector<Check> checks;
  for (const auto &row : table) {
    const double rate = row[0], R = bite.roll_radius;
    bite.gap_rate          = rate;
    const BiteState s      = solved(bite, Arc::rigid);
    const std::string name = rate > 0 ? "opening: " : "closing: ";
    const double h_exit    = bite.strip.exit_thickness + s.exit_position * s.exit_position / R;
    checks.push_back(relative(name + "volume balance", "mm2/s",
                              (s.entry_speed * bite.strip.entry_thickness - s.exit_speed * h_exit) * 1e6,
                              rate * (s.arc_length - s.exit_position) * 1e6, 1e-12));
    checks.push_back(relative(name + "2 x_d v_d / R", "m/s", 2 * s.exit_position * s.exit_speed / R, rate, 1e-12));
    checks.push_back(relative(name + "exit point", "mm", s.exit_position * 1e3, row[1] * 1e3, 1e-8));
    checks.push_back(relative(name + "entry speed", "m/s", s.entry_speed, row[2], 1e-8));
    checks.push_back(relative(name + "exit speed", "m/s", s.exit_speed, row[3], 1e-8));
    checks.push_back(relative(name + "force", "kN", s.force / 1e3, row[4] / 1e3, 1e-8));
    checks.push_back(relative(name + "friction", "-", s.friction, row[5], 1e-8));
  }
  return checks;
}

double diverges(const RollBite &bite)
{
  try {
    solved(bite);
  } catch (const SolverError &) {
    return 1;
  }
  return 0;
}

// CH-22, CH-25
std::vector<Check> film_limits()
{
  const Friction law = film_bite(2, 18.2).strip.friction;
  std::vector<Check> checks{absolute("condition 2 at 1 m/s reported as without flattened radius (1 = yes)", "-",
                                     diverges(film_bite(2, 1)), 1, 0),
                            absolute("condition 2 at 2 m/s likewise", "-", diverges(film_bite(2, 2)), 1, 0),
                            relative("friction at a film of 0.890293031 um", "-",
                                     film_friction(law, 0.890293031e-6), 0.0283203860, 1e-7),
                            relative("friction without a film", "-", film_friction(law, 0.), 0.154, 1e-7)};
  double low = 1, high = 0;
  for (double v = 15; v <= 20; v += 0.5) {
    const BiteState s = solved(film_bite(3, v));
    low               = std::min(low, s.neutral_position / s.arc_length);
    high              = std::max(high, s.neutral_position / s.arc_length);
  }
  checks.push_back({"condition 3, 15..20 m/s: smallest x_n / x_e", "-", low, 0, 0, Judged::at_least});
  checks.push_back(at_most("condition 3, 15..20 m/s: largest x_n / x_e", "-", high, 1));
  return checks;
}

// BI-04, BI-15, BI-16
std::vector<Check> demo_stiffness()
{
  const RollBite bite   = demo_bite();
  const BiteState s     = solved(bite, Arc::rigid);
  const BiteStiffness k = slab_stiffness(bite, s);
  std::vector<Check> checks{
      relative("dF/dk against F/k", "mm2/mm", by(s.force_by, Input::flow_stress) / 28e6, s.force / 28e6, 1e-10),
      relative("K4.plastic_slope", "kN/mm", k.plastic_slope / 1e6, 226.424, 1e-5),
      relative("K4.flattening, one roll", "kN/mm", k.flattening / 1e6, 9.6641e4, 1e-4),
      relative("K4.combined", "kN/mm", k.combined / 1e6, 1 / (1 / 226.424 + 2 / 9.6641e4), 1e-4),
      reported("K4.plastic_slope against the finite-element bite", "kN/mm", k.plastic_slope / 1e6, 225)};
  const double forces[5][6] = {{210, 8, 5, 28, 0.20, 963.08384},
                               {420, 120, 100, 60, 0.35, 6114.60500},
                               {300, 40, 30, 80, 0.30, 5238.51951},
                               {100, 10, 9, 300, 0.10, 3068.63610},
                               {250, 2.0, 1.5, 600, 0.06, 7612.47475}};
  const char *names[5]      = {"B1", "B3", "B4", "B7", "B8"};
  for (int i = 0; i < 5; ++i) {
    const double *p = forces[i];
    checks.push_back(relative(std::string(names[i]) + ": force", "N/mm",
                              solved(plain_bite(p[0], p[1], p[2], p[3], p[4]), Arc::rigid).force / 1e3, p[5],
                              1e-8));
  }
  return checks;
}
}  // namespace

std::vector<Case> slab_cases()
{
  const std::string liu = film_source, pass = film_passes;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("film-steady", "regression",
      pass + "Bland and Ford with film friction and Hitchcock's arc; also 5 to 25 m/s.",
      liu + "steady.*, speed_trend.condition_2, film_prefactor_1.5",
      "1e-8: fixed points converged to 1e-13. Inlet data are partly recovered ones: no evidence for the model.",
      film_steady);
  add("film-single-loop", "verification",
      pass + "Nested iterations (secant in R', Newton in the speed) against one plain loop.",
      "the same equations, iterated all at once from R' = 1.7 R", "1e-9: one fixed point.", film_single_loop);
  add("film-slab-equation", "verification",
      pass + "The closed pressure hill against Runge-Kutta of the equation it solves (4000 steps a side), and "
             "that of "
             "the full slab equation at the same R' and friction.",
      liu + "slab.*",
      "1e-9: closed form and integration to 1e-12; full equation 1e-8, ODE tolerance of the reference.",
      film_slab_equation);
  add("moving-gap", "regression",
      "Condition 2 with a gap that opens or closes at 0.02 m/s, R' of the steady state.",
      "volume balance and exit of a particle, exact; " + liu + "moving_gap.*",
      "1e-12: exact equations; 1e-8 as film-steady.", moving_gap);
  add("film-limits", "unit",
      "Where the film has broken down the flattening finds no radius and says so; the friction "
      "law at a known film; condition 3 (0.705 -> 0.506 mm) from 15 to 20 m/s.",
      "friction law; no published number for condition 3",
      "1e-7: seven digits of the film given; the reports are yes or no.", film_limits);
  add("demo-stiffness", "regression",
      "8 -> 5 mm, k 28 MPa, mu 0.2, R 210 mm, rigid arc: K4 by name and the force of "
      "four more passes.",
      "closed forms; forces by an independent program, nine digits; slope by fourth-order differences, six digits",
      "dF/dk by automatic differentiation: the force is proportional to k, 1e-10; the rest by the printed digits.",
      demo_stiffness);
  for (const auto &more : {film_coefficient_cases(), cluster_slab_cases()})
    cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}
}  // namespace mill::verify
