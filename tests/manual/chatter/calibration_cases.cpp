#include "core/base/errors.h"
#include "core/model/case.h"
#include "dynamics/chatter/modes.h"
#include "dynamics/chatter/speed.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <Eigen/LU>
#include <cmath>
#include <fmt/format.h>

// Stands and strips fitted to the published condition 2, and what they say then.
namespace mill::verify {
std::vector<Case> chatter_calibration_cases();

namespace {
using namespace dynamics;
using mill::Linearisation;

constexpr double printed_speed = 18.2, printed_force = 8751e3, printed_friction = 0.0283;  // of condition 2

Eigen::MatrixXd matrix_of(SixMasses stand, const double distance, const bite::LinearCoefficients &by)
{
  stand.distance = distance;
  return chatter_matrix(chatter_stand(stand), by);
}

// Distance to the neighbours at which nothing grows and something does not decay, by the secant from where the
// stand has it.
double calibrated_distance(const SixMasses &stand, const bite::LinearCoefficients &by)
{
  const auto growth = [&](const double distance) { return growth_rate(matrix_of(stand, distance, by)); };
  double before = stand.distance * 1.001, L = stand.distance, growth_before = growth(before);
  for (int i = 0; i < 30; ++i) {
    const double g = growth(L), next = L - g * (L - before) / (g - growth_before);
    before        = L;
    growth_before = g;
    L             = next;
    if (std::abs(L - before) < 1e-11)
      return L;
  }
  throw SolverError({"the calibration of the distance between the stands does not settle", "", "", "", ""});
}

WorkingPoint sequential_point(const bite::RollBite &bite, const double speed)
{
  return working_point(bite, speed, Linearisation::sequential);
}

// CH-17
std::vector<Check> growth()
{
  struct Row {
    const char *stand;
    double distance;      ///< m
    double below, above;  ///< 1/s at 18.0 and 18.4 m/s
  };
  const Row rows[] = {
      {"D", 4.9443849518888205, -0.6764853598983187, 0.7008200812582039},
      {"D36", 4.567983852516215, -0.5535070719760853, 0.5550685218755689},
      {"C", 6.051802230614177, -0.04609652141665066, 0.04605560922155982},
      {"A", 4.809966273021176, -0.05818133325298813, 0.058163980175748975},
      {"B", 5.213577423475784, -0.3811426455132718, 0.37853782330414276},
  };
  std::vector<Check> checks;
  for (const Row &r : rows) {
    const SixMasses stand  = six_masses(r.stand);
    const auto by          = [](const double speed) { return sequential_point(film_bite(2, speed), speed).by; };
    const double L         = calibrated_distance(stand, by(printed_speed));
    const auto value_at    = [&](const double speed) { return growth_rate(matrix_of(stand, L, by(speed))); };
    const std::string name = fmt::format("stand {}: ", r.stand);
    checks.push_back(absolute(name + "distance to the neighbours", "m", L, r.distance, 1e-6));
    checks.push_back(absolute(name + "growth rate at 18.0 m/s", "1/s", value_at(18.0), r.below, 1e-3));
    checks.push_back(absolute(name + "growth rate at 18.2 m/s", "1/s", value_at(18.2), 0, 1e-3));
    checks.push_back(absolute(name + "growth rate at 18.4 m/s", "1/s", value_at(18.4), r.above, 1e-3));
    const bool signs = value_at(18.0) < 0 && value_at(18.4) > 0;
    checks.push_back(absolute(name + "decays below and grows above (1: yes)", "-", signs, 1, 0));
  }
  return checks;
}

// CH-20
std::vector<Check> phases()
{
  struct Row {
    const char *stand;
    double frequency, ratio, force, entry, exit, friction, force_to_friction;
  };
  const Row rows[] = {
      {"D", 128.12014511114788, 0.015257630176816862, 178.3160298255655, -60.65458208230602, -93.13344023880187,
       179.99535875885624, -1.6793289332907477},
      {"D36", 131.86106606609755, 0.21081564758805257, 177.91351986926168, -59.783570914936874, -93.13289108209075,
       179.99515039687304, -2.0816305276113667},
      {"C", 81.33748412980316, 1.16509802344477, 166.62816829255632, -67.23728955436212, -106.21103935296041,
       179.9940843590463, -13.365916066489973},
      {"A", 100.51661292055044, 1.175993021795455, 169.14547347369805, -63.75435034315482, -102.23606772367813,
       179.99403896830347, -10.848565494605424},
      {"B", 105.79728814160711, 2.2649444500002818, 172.55522742338502, -63.615758679020416, -99.72730255992049,
       179.99470371104204, -7.4394762876570155},
  };
  std::vector<Check> checks;
  const WorkingPoint point = sequential_point(film_bite(2, printed_speed), printed_speed);
  for (const Row &r : rows) {
    SixMasses six                 = six_masses(r.stand);
    six.distance                  = calibrated_distance(six, point.by);
    const ChatterStandModel stand = chatter_stand(six);
    const ChatterMode mode        = chatter_mode(stand, point.by, eigenvalues(chatter_matrix(stand, point.by))[0]);
    const std::string name        = fmt::format("stand {}: ", r.stand);
    checks.push_back(relative(name + "frequency", "Hz", mode.frequency, r.frequency, 1e-6));
    checks.push_back(relative(name + "amplitude of the upper over that of the lower work roll", "-",
                              mode.work_roll_ratio, r.ratio, 1e-4));
    checks.push_back(absolute(name + "force against gap", "deg", mode.force_phase, r.force, 0.1));
    checks.push_back(absolute(name + "back tension against gap", "deg", mode.entry_tension_phase, r.entry, 0.1));
    checks.push_back(absolute(name + "front tension against gap", "deg", mode.exit_tension_phase, r.exit, 0.1));
    checks.push_back(absolute(name + "friction against gap", "deg", mode.friction_phase, r.friction, 0.1));
    checks.push_back(
        absolute(name + "force against friction", "deg", mode.force_to_friction, r.force_to_friction, 0.1));
  }
  return checks;
}

// A flow stress with one free number, and how far the fit has to find.
struct Law {
  const char *name;
  const char *parameter;
  const char *unit;
  double per_unit;    ///< SI per unit shown
  bool by_thickness;  ///< the free number is the reference thickness of the strain
  bite::RollBite bite;
  double radius, value, distance;  ///< m, SI, m: reference of the fit
  double speed, force, friction;   ///< m/s, N, -: reference of condition 1 then
};

double &free_number(const Law &law, bite::RollBite &bite)
{
  return law.by_thickness ? bite.strip.initial_thickness : bite.strip.flow_stress.k;
}

// Roll radius and free number by Newton's method on force and friction of condition 2.
bite::RollBite calibrated_bite(const Law &law)
{
  bite::RollBite bite = law.bite;
  const auto defect   = [&](const Eigen::Vector2d &log_scale) {
    bite::RollBite b = bite;
    b.roll_radius *= std::exp(log_scale[0]);
    free_number(law, b) *= std::exp(log_scale[1]);
    const bite::BiteState s = solved(b);
    return Eigen::Vector2d(s.force / printed_force - 1, s.friction / printed_friction - 1);
  };
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d d = defect({0, 0});
    Eigen::Matrix2d slope;
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d step = 1e-5 * Eigen::Vector2d::Unit(j);
      slope.col(j)               = (defect(step) - defect(-step)) / 2e-5;
    }
    const Eigen::Vector2d move = -slope.partialPivLu().solve(d);
    bite.roll_radius *= std::exp(move[0]);
    free_number(law, bite) *= std::exp(move[1]);
    if (move.norm() < 1e-12)
      return bite;
  }
  throw SolverError({"the calibration of roll and flow stress does not settle", "", "", "", ""});
}

// The strip, roll and law of one condition in the thicknesses and tensions of another.
bite::RollBite in_condition(const bite::RollBite &calibrated, const int condition, const double speed)
{
  bite::RollBite bite        = calibrated;
  const Strip strip          = film_bite(condition, speed).strip;
  bite.roll_speed            = speed;
  bite.strip.width           = strip.width;
  bite.strip.entry_thickness = strip.entry_thickness;
  bite.strip.exit_thickness  = strip.exit_thickness;
  bite.strip.entry_tension   = strip.entry_tension;
  bite.strip.exit_tension    = strip.exit_tension;
  return bite;
}

// CH-23
std::vector<Check> calibration()
{
  const bite::RollBite reduction_power = film_bite(2, printed_speed);
  bite::RollBite constant              = reduction_power;
  constant.strip.flow_stress           = {};
  constant.strip.flow_stress.k         = 770e6;
  bite::RollBite swift                 = reduction_power;
  swift.strip.flow_stress              = {};
  swift.strip.flow_stress.law          = FlowStressLaw::swift;
  swift.strip.flow_stress.k            = 720e6;
  swift.strip.flow_stress.eps0         = 0.01;
  swift.strip.flow_stress.n            = 0.2;
  swift.strip.initial_thickness        = 2.8e-3;
  const Law laws[]                     = {
                          {"power of the total reduction", "reference thickness", "mm", 1e-3, true, reduction_power,
                           0.3001280575537591, 0.0030313529929021504, 4.933615381525258, 18.637591809372744, 8309658.560763872,
                           0.024331514255734148},
                          {"constant", "flow stress", "MPa", 1e6, false, constant, 0.2999158367543196, 773093599.2014811,
                           4.945826381437333, 18.593689951752065, 8278745.566892506, 0.024427065374318123},
                          {"Swift", "factor", "MPa", 1e6, false, swift, 0.30026204810101215, 716878989.2977476, 4.917444900315908,
                           18.664224292562377, 8329464.965315567, 0.024273323857228808},
  };
  std::vector<Check> checks;
  for (const Law &law : laws) {
    bite::RollBite bite    = calibrated_bite(law);
    const std::string name = fmt::format("{}: ", law.name);
    SixMasses stand        = six_masses("D");
    stand.distance         = calibrated_distance(stand, sequential_point(bite, printed_speed).by);
    checks.push_back(relative(name + "roll radius", "mm", bite.roll_radius * 1e3, law.radius * 1e3, 1e-5));
    checks.push_back(relative(name + law.parameter, law.unit, free_number(law, bite) / law.per_unit,
                              law.value / law.per_unit, 1e-5));
    checks.push_back(relative(name + "distance to the neighbours", "m", stand.distance, law.distance, 1e-5));
    const StandSpeed blind =
        critical_speed(chatter_stand(stand), in_condition(bite, 1, printed_speed), Linearisation::sequential);
    checks.push_back(relative(name + "condition 1, critical speed", "m/s", blind.speed, law.speed, 1e-5));
    if (!blind.at)
      continue;
    checks.push_back(
        relative(name + "condition 1, force there", "kN", blind.at->state.force / 1e3, law.force / 1e3, 1e-5));
    checks.push_back(
        relative(name + "condition 1, friction there", "-", blind.at->state.friction, law.friction, 1e-5));
  }
  return checks;
}
}  // namespace

std::vector<Case> chatter_calibration_cases()
{
  const std::string liu = chatter_source, stands = chatter_stands;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const std::string &problem, const std::string &source, const char *reason,
                       std::vector<Check> (*run)()) {
    cases.push_back({name, "regression", problem, source, reason, run});
  };
  add("chatter-growth",
      stands +
          "Condition 2, five variants of the stand, the distance between the stands fitted so that 18.2 m/s is "
          "critical: decay at 18.0, growth at 18.4 m/s. The zero at 18.2 m/s agrees by construction; all rows "
          "are regression values.",
      liu + "growth", "1e-6 m: fit; 1e-3 1/s: growth rates of 0.05 to 0.7 1/s from roots of modulus 500 to 1000.",
      growth);
  add("chatter-phases",
      stands +
          "Critical mode at 18.2 m/s with the distances of chatter-growth: ratio of the work rolls and phases "
          "against the gap. Force in antiphase with the gap, friction in phase with the force; which roll "
          "moves more depends on the reading of the stand.",
      liu + "phases", "0.1 degrees: last digit that means something for a mill; ratio 1e-4 (small in stand D).",
      phases);
  add("chatter-calibration",
      stands +
          "Roll radius, one number of the flow stress and the distance between the stands fitted by Newton's "
          "method to force 8751 kN, friction 0.0283 and critical speed 18.2 m/s of condition 2, for three laws "
          "of hardening. The fitted numbers are regression values; condition 1 is predicted with them.",
      liu + "calibration.*", "1e-5: roots of a fit to printed numbers, converged to 1e-11 on both sides.",
      calibration);
  return cases;
}
}  // namespace mill::verify
