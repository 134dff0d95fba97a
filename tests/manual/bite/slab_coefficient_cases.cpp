#include "reduce/bite/slab/bland_ford.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/solvers/closed_coefficients.h"
#include <algorithm>
#include <cmath>

// The bite of a vibrating mill: derivatives of speeds, force and friction in three linearisations.
namespace mill::verify {
std::vector<Case> film_coefficient_cases();

namespace {
using namespace bite;

// Largest relative deviation of a row; entries whose reference is zero must be zero.
double deviation(const StripRow &row, const StripRow &reference)
{
  double largest = 0;
  for (int i = 0; i < 5; ++i)
    largest =
        std::max(largest, reference[i] == 0 ? (row[i] == 0 ? 0. : INFINITY) : std::abs(row[i] / reference[i] - 1));
  return largest;
}

void compare(std::vector<Check> &checks, const std::string &name, const LinearCoefficients &a,
             const LinearCoefficients &b, const double tolerance)
{
  checks.push_back(
      at_most(name + "entry speed, largest deviation", "-", deviation(a.entry_speed, b.entry_speed), tolerance));
  checks.push_back(at_most(name + "exit speed", "-", deviation(a.exit_speed, b.exit_speed), tolerance));
  checks.push_back(at_most(name + "force", "-", deviation(a.force, b.force), tolerance));
  checks.push_back(at_most(name + "friction", "-", deviation(a.friction, b.friction), tolerance));
  checks.push_back(
      at_most(name + "neutral point", "-", deviation(a.neutral_position, b.neutral_position), tolerance));
}

// CH-06
std::vector<Check> film_coefficients()
{
  const LinearCoefficients sequential_1{
      {23300.191808365573, 11.161088308285944, -3.067517719328062e-09, 3.1864057486762524e-09,
       -17470.134753275437},
      {-3472.0845199401124, -2.895656041116729, -4.077422320585717e-09, 4.235451303258047e-09, 2690.557057468568},
      {-30473796670.0439, -12929281.466695448, -0.009154291416232299, -0.004621608970986794, 27536878336.113884},
      {-79.15564748689015, 0, -3.1615638542157553e-15, 0, 79.15532860826849},
      {-5.707457651030502, 0.007174842084636199, -1.0103016672964735e-11, 1.0494580097408067e-11,
       6.666648846730966}};
  const LinearCoefficients sequential_2{
      {21119.201116821543, 11.343429607363573, -2.5696566128102043e-09, 2.5177317948477384e-09,
       -15392.733924502352},
      {-3743.8703647964007, -2.794289593782655, -3.5137938778288573e-09, 3.442790963838588e-09, 2808.81744283405},
      {-30761888259.917404, -13723192.699184677, -0.010356604289356561, -0.004622552460873969, 27170003367.692833},
      {-83.27292370481666, 0, -6.528674192745793e-15, 0, 83.2722582213333},
      {-6.890646641149111, 0.007228486539541309, -9.089756410760971e-12, 8.906080527921608e-12,
       7.266068314010992}};
  const LinearCoefficients implicit{
      {20552.3143916174, 11.033463551082582, -2.5284622206938446e-09, 2.477369814074222e-09, -14978.997832093632},
      {-4519.0412940616825, -3.2181426586105606, -3.457463937829191e-09, 3.387599277824196e-09, 3374.567489472664},
      {-33672311206.89294, -15314572.921854105, -0.010145110354551535, -0.004829772756932803, 29294143806.692703},
      {-118.48938553088122, -0.01925588888055973, 2.55257294684325e-12, -2.5073900868343784e-12,
       108.97460872024445},
      {-8.895919337474247, 0.00613203033089747, -8.944037722917468e-12, 8.763306364378468e-12, 8.72959471656115}};
  const LinearCoefficients frozen{
      {22459.662723962872, 11.343429607363573, -2.569551519381133e-09, 2.5177317948477384e-09, -16733.18481921736},
      {-1910.899466989623, -2.794289593782655, -3.5136501712161423e-09, 3.442790963838588e-09, 975.8611933883982},
      {-23879895707.421257, -13723192.699184677, -0.010356064734778994, -0.004622552460873969, 20288065813.294174},
      {0, 0, 0, 0, 0},
      {-2.1489743779564057, 0.007228486539541309, -9.089384659272517e-12, 8.906080527921608e-12,
       2.524433944342786}};
  const auto both            = working_conditions();
  const auto coefficients_of = [&](const int i, const Linearisation scheme) {
    return linear_coefficients(both[i].bite, both[i].state, scheme);
  };
  std::vector<Check> checks;
  compare(checks, "condition 1, in sequence: ", coefficients_of(0, Linearisation::sequential), sequential_1, 1e-8);
  compare(checks, "condition 2, in sequence: ", coefficients_of(1, Linearisation::sequential), sequential_2, 1e-8);
  compare(checks, "condition 2, implicit: ", coefficients_of(1, Linearisation::implicit), implicit, 1e-8);
  compare(checks, "condition 2, friction frozen: ", coefficients_of(1, Linearisation::frozen_friction), frozen,
          1e-8);
  return checks;
}

// CH-07
std::vector<Check> film_closed_coefficients()
{
  std::vector<Check> checks;
  for (const auto &[name, bite, s] : working_conditions())
    compare(checks, name, linear_coefficients(bite, s, Linearisation::sequential), closed_coefficients(bite, s),
            1e-12);
  return checks;
}

// CH-08: differences of states in which the same things are held.
std::vector<Check> film_differences()
{
  const RollBite bite  = film_bite(2, 18.2);
  const BiteState s    = solved(bite);
  const Input rows[5]  = {Input::exit_thickness, Input::gap_rate, Input::entry_tension, Input::exit_tension,
                          Input::entry_thickness};
  const double step[5] = {1e-9, 1e-4, 1e4, 1e4, 1e-9};
  std::vector<Check> checks;
  for (const bool implicit : {false, true}) {
    LinearCoefficients d{};
    for (int i = 0; i < 5; ++i) {
      double values[2][3];
      for (const int side : {0, 1}) {
        auto in = pass_inputs<double>(bite, s.flattened_radius);
        input(in, rows[i]) += side ? step[i] : -step[i];
        double v = s.entry_speed;
        Held<double> held;
        held.exit_speed = &s.exit_speed;
        const auto c =
            implicit ? settled_bland_ford(bite.strip, in, v) : bland_ford_contact(bite.strip, in, v, held);
        const auto F    = bland_ford_force(bite.strip, in, c, even_rules(16));
        values[side][0] = c.entry_speed;
        values[side][1] = c.exit_speed;
        values[side][2] = bite.strip.width * (F.entry + F.exit);
      }
      const auto slope = [&](const int j) { return (values[1][j] - values[0][j]) / (2 * step[i]); };
      d.entry_speed[i] = slope(0);
      d.exit_speed[i]  = slope(1);
      d.force[i]       = slope(2);
    }
    const LinearCoefficients exact =
        linear_coefficients(bite, s, implicit ? Linearisation::implicit : Linearisation::sequential);
    const std::string name = implicit ? "implicit: " : "in sequence: ";
    checks.push_back(
        at_most(name + "entry speed, largest deviation", "-", deviation(exact.entry_speed, d.entry_speed), 1e-6));
    checks.push_back(at_most(name + "exit speed", "-", deviation(exact.exit_speed, d.exit_speed), 1e-6));
    checks.push_back(at_most(name + "force", "-", deviation(exact.force, d.force), 1e-6));
  }
  return checks;
}

// CH-09: the force integral cut off at the line of centres instead of the moving exit.
std::vector<Check> film_moving_limit()
{
  const RollBite bite  = film_bite(2, 18.2);
  const BiteState s    = solved(bite);
  auto in              = pass_inputs<Dual<1>>(bite, s.flattened_radius);
  in.gap_rate.by[0]    = 1;
  const auto c         = bland_ford_contact(bite.strip, in, Dual<1>(s.entry_speed));
  const auto whole     = bland_ford_force(bite.strip, in, c, even_rules(16));
  const Dual<1> scale  = sqrt(in.radius * in.exit_thickness);
  const GaussRule rule = gauss_legendre(16);
  Dual<1> cut          = whole.entry;
  for (int i = 0; i < 16; ++i) {  // exit side from 0
    const Dual<1> t = c.neutral_angle * (0.5 * (1 + rule.node[i])), cosine = cos(t);
    cut += 0.5 * rule.weight[i] * c.neutral_angle * scale / (cosine * cosine) *
           bland_ford_pressure(bite.strip, in, c, t, false);
  }
  const double width = bite.strip.width, lost = width * ((whole.entry + whole.exit).by[0] - cut.by[0]);
  const double x_d =
      s.flattened_radius * bite.strip.exit_thickness / (2 * s.entry_speed * bite.strip.entry_thickness);
  return {relative("lost of dF/d(gap rate)", "MN s/m", lost / 1e6,
                   -(s.exit_flow_stress - bite.strip.exit_tension) * width * x_d / 1e6, 1e-8),
          relative("force, which must not change", "kN", width * cut.value / 1e3, s.force / 1e3, 1e-12)};
}

}  // namespace

std::vector<Case> film_coefficient_cases()
{
  const std::string liu = film_source, pass = film_passes;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("film-coefficients", "regression",
      pass + "Derivatives of speeds, force, friction and neutral point by gap, gap "
             "rate, tensions and entry thickness in three linearisations, by automatic differentiation.",
      liu + "coefficients.*", "1e-8: exact derivatives at a state of 1e-13.", film_coefficients);
  add("film-closed-coefficients", "verification",
      pass + "Automatic differentiation against the derivatives written out by hand.",
      "theory.md (8.29)-(8.33), differentiated on paper", "1e-12: both exact.", film_closed_coefficients);
  add("film-differences", "verification",
      pass + "Condition 2: central differences (1e-9 m, 1e-4 m/s, 1e4 Pa) against the derivatives.",
      "differences of states", "1e-6: truncation and rounding.", film_differences);
  add("film-moving-limit", "unit",
      "Condition 2: what dF/d(gap rate) loses if the force integral ends on the line of centres.",
      "-(k_fd - sigma_d) B dx_d/d(gap rate), closed form",
      "1e-8: exact up to the rounding of a difference of two slopes.", film_moving_limit);
  return cases;
}
}  // namespace mill::verify
