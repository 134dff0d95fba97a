#include "core/base/errors.h"
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/hu_ehmann.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/slab_bite.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>

// Thin hard strip between small rolls: passes of a cluster mill by the theories of Bland and Ford and of Hu and
// Ehmann.
namespace mill::verify {
std::vector<Case> cluster_slab_cases();

namespace {
using namespace bite;

constexpr int some_passes[3] = {1, 3, 5};

std::string pass_name(const int pass)
{
  return "pass " + std::to_string(pass) + ": ";
}

// CL-01
std::vector<Check> cluster_inputs()
{
  const double sigma[5][2] = {{289413556.7402894, 385038503.85038507},
                              {341034103.4103411, 464322294.29839534},
                              {423352680.0955957, 462046204.620462},
                              {379537953.7953795, 471475719.0004715},
                              {414898632.7204149, 416883793.64252216}};
  const double omega[5]    = {85.24904214559388, 112.54789272030652, 118.77394636015327, 126.91570881226055,
                              239.46360153256708};
  // falling and rising with the speed in m/s, then in m/min
  const double mu[5][4] = {{0.05952415389897671, 0.0739218461010233, 0.032419592897066404, 0.1010264071029336},
                           {0.05768510489827598, 0.07576089510172403, 0.03058054389636567, 0.10286545610363435},
                           {0.057328662702298125, 0.07611733729770188, 0.03022410170038782, 0.10322189829961219},
                           {0.05688974955388152, 0.0765562504461185, 0.029785188551971216, 0.1036608114480288},
                           {0.052686855390355405, 0.0807591446096446, 0.025582294388445094, 0.10786370561155492}};
  const double speed[5] = {178, 235, 248, 265, 500};
  double stress = 0, rotation = 0, friction = 0;
  for (int i = 0; i < 5; ++i) {
    const RollBite b = cluster_bite(i + 1, 1e9, 0.05);
    stress           = std::max({stress, std::abs(b.strip.entry_tension / sigma[i][0] - 1),
                                 std::abs(b.strip.exit_tension / sigma[i][1] - 1)});
    rotation         = std::max(rotation, std::abs(speed[i] / 60 / b.roll_radius / omega[i] - 1));
    for (int reading = 0; reading < 4; ++reading) {
      Friction law;
      law.law           = FrictionLaw::speed;
      law.at_unit_speed = 0.066723;
      law.per_log_speed = reading % 2 ? 0.00662 : -0.00662;
      friction          = std::max(
                   friction, std::abs(speed_friction(law, reading < 2 ? speed[i] / 60 : speed[i]) / mu[i][reading] - 1));
    }
  }
  return {at_most("tension stresses, largest deviation", "-", stress, 1e-9),
          at_most("rotation of the work roll", "-", rotation, 1e-9),
          at_most("friction by the speed law, four readings", "-", friction, 1e-9)};
}

// CL-02
std::vector<Check> cluster_vector()
{
  const RollBite bite = cluster_bite(1, 1.2e9, 0.06);
  const BiteState s   = solve_slab(bite, {Theory::bland_ford, Arc::rigid});
  return {
      relative("force per width", "N/mm", s.force / 0.505 / 1e3, 1696467.430690953 / 1e3, 1e-8),
      relative("neutral point over arc", "-", s.neutral_position / s.arc_length, 0.3307928123426909, 1e-8),
      relative("peak pressure", "MPa", s.peak_pressure / 1e6, 1227568156.7614908 / 1e6, 1e-8),
      relative("force with flattening", "kN", solve_slab(bite, {}).force / 1e3, 1188311.3845946759 / 1e3, 1e-9),
      relative("Hitchcock's radius under 1148 kN", "mm", hitchcock_radius(bite, 1.148e6) * 1e3, 56.62388047537423,
               1e-9)};
}

struct Tuned {
  double k_rigid, k_flat, radius, neutral_rigid, neutral_flat, peak_rigid, peak_flat;
  double at_mu_rigid[4], at_mu_flat[4];
  double full[2], arc[2], power, per_speed, torque, factor;
};

// Independent program, entries tuned_k.pass_1, 3, 5.
const Tuned tuned[3] = {{1501051462.502769,
                         1180364655.4941888,
                         0.05662388047537422,
                         0.3162008973122604,
                         0.35724795501034884,
                         1644018406.6817942,
                         1376925599.4678903,
                         {1682929776.4382138, 1554248169.435775, 1396041978.0353293, 1302518376.9558191},
                         {1342393528.898621, 1228658570.6412065, 1084837218.0550098, 1000588935.8595394},
                         {1118483.9400807833, 1116501.7918000338},
                         {1119303.6875113235, 1117126.5904804554},
                         117050.08374048505,
                         19727.542203452536,
                         686.5184686801482,
                         0.1062870112298495},
                        {3141593760.657045,
                         1589191080.7441237,
                         0.1264755062756487,
                         0.3745192840178778,
                         0.4286498308511055,
                         3838305728.702103,
                         2402342877.489029,
                         {3459856374.3544297, 3221976420.472104, 2907387243.179433, 2715602076.861953},
                         {1857035952.4159834, 1656521051.2991252, 1399195782.059228, 1252917813.8513815},
                         {1501096.3501128773, 1496517.7442188838},
                         {1501712.9530728548, 1496803.1154753016},
                         75329.7804969383,
                         9112.473447210277,
                         317.11407596291764,
                         0.10787026196219453},
                        {4216465803.6354003,
                         1532135384.1079879,
                         0.2328117935814443,
                         0.4097981367070719,
                         0.4577665416030188,
                         5048012471.998979,
                         2459639137.0769377,
                         {4505274160.426099, 4249361992.973628, 3896116599.696164, 3675663837.4336815},
                         {1771891700.2153301, 1558703012.0460317, 1288049857.1564505, 1137531860.4719017},
                         {1300818.0107525003, 1298278.1505589874},
                         {1301130.3526350704, 1298381.404513421},
                         61304.61716091097,
                         3678.2770296546582,
                         128.0040406319821,
                         0.10163953285905976}};

// Flow stress that returns the printed force.
double tuned_stress(const int pass, const double mu, const Arc arc)
{
  return rising_root(1e8, 8e9, cluster_force(pass),
                     [&](const double k) { return force_or_limit(cluster_bite(pass, k, mu), arc); });
}

// CL-03, CL-04
std::vector<Check> cluster_slab_equation()
{
  std::vector<Check> checks;
  for (int i = 0; i < 3; ++i) {
    const int pass = some_passes[i];
    for (const bool flat : {false, true}) {
      const Tuned &t  = tuned[i];
      const double mu = cluster_friction(pass), R = flat ? t.radius : 0.0348;
      RollBite bite          = cluster_bite(pass, flat ? t.k_flat : t.k_rigid, mu);
      bite.roll_radius       = R;
      const double closed    = solve_slab(bite, {Theory::bland_ford, Arc::rigid}).force;
      const std::string name = pass_name(pass) + (flat ? "R', " : "R, ");
      checks.push_back(relative(name + "closed form against its own equation", "kN", closed / 1e3,
                                integrate_slab(bite, R, mu, false).force / 1e3, 1e-9));
      const double full = integrate_slab(bite, R, mu, true).force;
      checks.push_back(
          relative(name + "full slab equation on the parabola", "kN", full / 1e3, t.full[flat] / 1e3, 1e-8));
      KarmanOptions options;
      options.derivatives             = false;
      options.points                  = 0;
      bite.strip.friction.shear_limit = not_given;
      const double arc                = solve_karman(bite, Theory::karman, Arc::rigid, nullptr, options).force;
      checks.push_back(
          relative(name + "full slab equation on the circle", "kN", arc / 1e3, t.arc[flat] / 1e3, 1e-6));
      checks.push_back(reported(name + "full equation over the closed form", "-", full / closed, 1));
    }
  }
  return checks;
}

// CL-05
std::vector<Check> cluster_tuned()
{
  const double mus[4] = {0.03, 0.05, 0.08, 0.10};
  std::vector<Check> checks;
  for (int i = 0; i < 3; ++i) {
    const int pass         = some_passes[i];
    const Tuned &t         = tuned[i];
    const std::string name = pass_name(pass);
    const double mu        = cluster_friction(pass);
    for (const bool flat : {false, true}) {
      const Arc arc         = flat ? Arc::hitchcock : Arc::rigid;
      const double k        = tuned_stress(pass, mu, arc);
      const RollBite bite   = cluster_bite(pass, k, mu);
      const BiteState s     = solve_slab(bite, {Theory::bland_ford, arc});
      const std::string how = flat ? "flattened, " : "rigid, ";
      checks.push_back(relative(name + how + "flow stress for the printed force", "MPa", k / 1e6,
                                (flat ? t.k_flat : t.k_rigid) / 1e6, 1e-7));
      checks.push_back(relative(name + how + "neutral point over arc", "-", s.neutral_position / s.arc_length,
                                flat ? t.neutral_flat : t.neutral_rigid, 1e-7));
      checks.push_back(relative(name + how + "peak pressure", "MPa", s.peak_pressure / 1e6,
                                (flat ? t.peak_flat : t.peak_rigid) / 1e6, 1e-7));
      if (flat)
        checks.push_back(relative(name + "R'", "mm", s.flattened_radius * 1e3, t.radius * 1e3, 1e-7));
      double worst = 0;
      for (int j = 0; j < 4; ++j)
        worst = std::max(worst,
                         std::abs(tuned_stress(pass, mus[j], arc) / (flat ? t.at_mu_flat : t.at_mu_rigid)[j] - 1));
      checks.push_back(at_most(name + how + "flow stress at mu 0.03..0.10, largest deviation", "-", worst, 1e-7));
      if (flat) {
        // friction factor of the other theory for the same force on the same arc
        const Strip &strip    = bite.strip;
        const auto factor_for = [&](const auto &force) {
          return rising_root(0.01, 0.5, cluster_force(pass), force);
        };
        const double published = factor_for([&](const double m) {
          return strip.width * published_hu_ehmann_force(t.radius, strip.entry_thickness, strip.exit_thickness,
                                                         strip.entry_tension, strip.exit_tension, 0.5 * k, m, m,
                                                         0);
        });
        const double exact     = factor_for([&](const double m) {
          RollBite other                    = bite;
          other.roll_radius                 = t.radius;
          other.strip.friction              = {};
          other.strip.friction.law          = FrictionLaw::factor;
          other.strip.friction.entry_factor = other.strip.friction.exit_factor = m;
          return force_or_limit(other, Arc::rigid);
        });
        checks.push_back(relative(name + "friction factor of equal force, published form of Hu and Ehmann", "-",
                                  published, t.factor, 1e-7));
        checks.push_back(reported(name + "friction factor of equal force, closed form", "-", exact, t.factor));
        // power of homogeneous deformation of both rolls
        const double v[3] = {178. / 60, 248. / 60, 500. / 60};
        const double power =
            k * strip.width * v[i] * strip.exit_thickness * std::log(strip.entry_thickness / strip.exit_thickness);
        checks.push_back(relative(name + "power of deformation", "kW", power / 1e3, t.power / 1e3, 1e-7));
        checks.push_back(relative(name + "power over 2 v", "N", power / (2 * v[i]), t.per_speed, 1e-7));
        checks.push_back(
            relative(name + "torque of deformation", "N m", power * 0.0348 / (2 * v[i]), t.torque, 1e-7));
        checks.push_back(reported(name + "torque by the friction stress", "N m", s.torque, t.torque));
      }
    }
  }
  return checks;
}

// Friction that returns the printed force at a flow stress.
double needed_friction(const int pass, const double k, const Arc arc)
{
  return rising_root(0.005, 0.6, cluster_force(pass),
                     [&](const double mu) { return force_or_limit(cluster_bite(pass, k, mu), arc); });
}

// CL-06: k = 2 Y ln(h0/h)^n, straight line through the tuned flow stresses of passes 1, 3, 5 in logarithms.
void hardening_fit(std::vector<Check> &checks, const Arc arc, const double (&r)[11])
{
  double x[3], y[3], mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (int i = 0; i < 3; ++i) {
    const int pass = some_passes[i];
    x[i]           = std::log(std::log(0.260e-3 / cluster_bite(pass, 1e9, 0.05).strip.exit_thickness));
    y[i]           = std::log(0.5 * tuned_stress(pass, cluster_friction(pass), arc));
    mean_x += x[i] / 3;
    mean_y += y[i] / 3;
  }
  for (int i = 0; i < 3; ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double n = xy / xx, Y = std::exp(mean_y - n * mean_x);
  const std::string how = arc == Arc::rigid ? "rigid: " : "flattened: ";
  checks.push_back(relative(how + "Y", "MPa", Y / 1e6, r[0] / 1e6, 1e-5));
  checks.push_back(relative(how + "n", "-", n, r[1], 1e-5));
  for (int i = 0; i < 3; ++i) {
    const int pass  = some_passes[i];
    const double k  = 2 * Y * std::exp(n * x[i]);
    const auto name = how + pass_name(pass);
    checks.push_back(relative(name + "flow stress", "MPa", k / 1e6, r[2 + i] / 1e6, 1e-5));
    checks.push_back(relative(name + "force", "kN",
                              force_or_limit(cluster_bite(pass, k, cluster_friction(pass)), arc) / 1e3,
                              r[5 + i] / 1e3, 1e-5));
    checks.push_back(
        relative(name + "friction for the printed force", "-", needed_friction(pass, k, arc), r[8 + i], 1e-5));
  }
}

std::vector<Check> cluster_hardening()
{
  std::vector<Check> checks;
  hardening_fit(checks, Arc::hitchcock,
                {802156645.762721, 0.289699652791619, 1200663520.3135266, 1489106373.9433239, 1607468309.8507335,
                 1185074.4212253627, 1253281.049320555, 1560110.3073933201, 0.05545316126105911,
                 0.06887192948533465, 0.045189060255219855});
  hardening_fit(checks, Arc::rigid,
                {2071300626.0352516, 1.0185542569550932, 1495321677.4190478, 3187766707.442227, 4171315414.5598474,
                 1142424.8088370245, 1532737.3451770723, 1286533.107706715, 0.06058584760086838,
                 0.053088979517345265, 0.056411610740154036});
  // n = 0.25 and Y of pass 1 kept for the others
  const double forces[3] = {1148000.0000000002, 763326.3954857176, 519034.45898074226};
  const double mus[3]    = {0.059524153898976605, 0.21842641871393384, 0.3135101059521076};
  const auto thinning    = [](const int pass) {
    return std::log(0.260e-3 / cluster_bite(pass, 1e9, 0.05).strip.exit_thickness);
  };
  const double Y = 0.5 * tuned_stress(1, cluster_friction(1), Arc::rigid) / std::pow(thinning(1), 0.25);
  checks.push_back(relative("frozen: Y", "MPa", Y / 1e6, 963795428.6448574 / 1e6, 1e-5));
  for (int i = 0; i < 3; ++i) {
    const int pass = some_passes[i];
    const double k = 2 * Y * std::pow(thinning(pass), 0.25);
    checks.push_back(relative("frozen: " + pass_name(pass) + "force", "kN",
                              force_or_limit(cluster_bite(pass, k, cluster_friction(pass)), Arc::rigid) / 1e3,
                              forces[i] / 1e3, 1e-5));
    checks.push_back(relative("frozen: " + pass_name(pass) + "friction for the printed force", "-",
                              needed_friction(pass, k, Arc::rigid), mus[i], 1e-5));
  }
  return checks;
}

// CL-07
std::vector<Check> cluster_no_root()
{
  const auto none = [](const RollBite &bite) {
    return force_or_limit(bite, Arc::hitchcock) == INFINITY ? 1. : 0.;
  };
  const auto yes = [&](const std::string &name, const RollBite &bite, const double expected) {
    return Check{name + " reported as without root (1 = yes)", "-", none(bite), expected, 0, Judged::absolute};
  };
  return {yes("pass 5, k 2000 MPa, mu 0.10", cluster_bite(5, 2.0e9, 0.10), 1),
          yes("pass 3, k 2500 MPa, mu 0.10", cluster_bite(3, 2.5e9, 0.10), 1),
          yes("pass 5, k 1130 MPa, mu 0.10", cluster_bite(5, 1.13e9, 0.10), 0)};
}

// CL-08, CL-09
std::vector<Check> hu_ehmann()
{
  RollBite bite                    = cluster_bite(1, 1.4e9, 0);
  bite.strip.entry_tension         = 2.9e8;
  bite.strip.exit_tension          = 3.85e8;
  bite.strip.friction.law          = FrictionLaw::factor;
  bite.strip.friction.entry_factor = 0.15;
  bite.strip.friction.exit_factor  = 0.10;
  bite.roll_speed                  = 3;
  const double table[2][4]         = {{0, 2212659.181326249, 2207273.593522435, 0.40988816896697766},
                                      {0.00015, 1982042.794075721, 1977031.8199758758, 0.4504176423645515}};
  const HillRules rules            = even_rules(32);
  std::vector<Check> checks;
  for (const auto &row : table) {
    // The gap rate that puts the exit where the entry asks for it.
    bite.gap_rate = row[0] == 0 ? 0 : 0.01;
    for (int i = 0; i < 40 && row[0] != 0; ++i)
      bite.gap_rate *= row[0] / solve_hu_ehmann(bite, Arc::rigid, 0).exit_position;
    const BiteState s = solve_hu_ehmann(bite, Arc::rigid, 0);
    double v          = s.entry_speed;
    const auto in     = pass_inputs<double>(bite, bite.roll_radius);
    const double sum  = hu_ehmann_state(bite, in, v, rules, Integration::quadrature).force;
    const double w    = bite.strip.width;
    const double published =
        published_hu_ehmann_force(0.0348, 0.260e-3, 0.180e-3, 2.9e8, 3.85e8, 0.7e9, 0.15, 0.10, row[0]);
    const std::string name = row[0] == 0 ? "gap at rest: " : "exit 0.15 mm upstream: ";
    checks.push_back(
        relative(name + "closed form against quadrature", "N/mm", s.force / w / 1e3, sum / w / 1e3, 1e-12));
    checks.push_back(relative(name + "closed form", "N/mm", s.force / w / 1e3, row[2] / 1e3, 1e-10));
    checks.push_back(
        relative(name + "neutral point over arc", "-", s.neutral_position / s.arc_length, row[3], 1e-10));
    checks.push_back(relative(name + "published form", "N/mm", published / 1e3, row[1] / 1e3, 1e-10));
    checks.push_back({name + "published over closed form - 1", "-", published / (s.force / w) - 1,
                      row[1] / row[2] - 1, 1e-4, Judged::absolute});
  }
  RollBite vector                    = cluster_bite(1, 1.2e9, 0);
  vector.strip.friction.law          = FrictionLaw::factor;
  vector.strip.friction.entry_factor = 0.10;
  vector.strip.friction.exit_factor  = 0.12;
  const Strip &s                     = vector.strip;
  checks.push_back(relative("m 0.10 / 0.12: closed form", "N/mm",
                            solve_hu_ehmann(vector, Arc::rigid, 0).force / s.width / 1e3, 1676820.5698435088 / 1e3,
                            1e-9));
  checks.push_back(relative("m 0.10 / 0.12: published form", "N/mm",
                            published_hu_ehmann_force(0.0348, s.entry_thickness, s.exit_thickness, s.entry_tension,
                                                      s.exit_tension, 0.6e9, 0.10, 0.12, 0) /
                                1e3,
                            1680359.0937218107 / 1e3, 1e-9));
  return checks;
}
}  // namespace

std::vector<Case> cluster_slab_cases()
{
  const std::string brusa =
      "E. Brusa, L. Lemma, J. Mater. Process. Technol. 209 (2009) 2436; values by an independent "
      "program, entries ";
  const std::string fitted = " Flow stress is tuned to the printed force: a regression, no evidence.";
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("cluster-inputs", "regression",
      "Five passes of a cluster mill, 0.260 to 0.095 mm: tension stresses, rotation, friction by "
      "the speed law in its four readings.",
      brusa + "tension_stress, kinematics.omega, friction", "1e-9: closed forms.", cluster_inputs);
  add("cluster-vector", "regression",
      "Pass 1 (0.260 -> 0.180 mm, R 34.8 mm, tensions 38 and 35 kN) at k 1200 MPa, mu 0.06: Bland and "
      "Ford, rigid and flattened.",
      brusa + "vector.bland_ford, vector.hitchcock", "1e-8 closed form; 1e-9 root in R'.", cluster_vector);
  add("cluster-slab-equation", "verification",
      "Passes 1, 3, 5 at R and R': the closed form against Runge-Kutta of its own "
      "equation, and what the step of Bland and Ford and the parabola cost.",
      brusa + "tuned_k.*",
      "1e-9: closed form and integration to 1e-12; 1e-8 and 1e-6 on the full equation: ODE tolerances.",
      cluster_slab_equation);
  add("cluster-tuned", "regression",
      "Passes 1, 3, 5: flow stress that returns the printed force, at friction by the speed law and "
      "0.03 to 0.10, rigid and flattened; power; friction factor of equal force." +
          fitted,
      brusa + "tuned_k.*", "1e-7: root finding within the reference.", cluster_tuned);
  add("cluster-hardening", "regression",
      "Hardening law fitted to passes 1, 3, 5, the forces it gives and the friction that would be "
      "needed; Y of pass 1 kept for all." +
          fitted,
      brusa + "hardening.*, frozen_Y", "1e-5: amplified by the flattening.", cluster_hardening);
  add("cluster-no-root", "unit",
      "Strip so hard and thin that no flattened radius carries its own force, and one just below.",
      "no root of P(R'(P)) = P, by scan", "yes or no.", cluster_no_root);
  add("hu-ehmann", "verification",
      "Pass 1 with friction factors, gap at rest and with the exit moved upstream: closed form, "
      "quadrature of the same equation, and the form as published, which leaves out h_c/R.",
      brusa + "hu_ehmann.check, vector.hu_ehmann",
      "1e-12 between closed form and quadrature; 1e-10 and 1e-9 as the references were integrated; 1e-4 on the "
      "published form's excess "
      "of 0.24 to 0.25 %.",
      hu_ehmann);
  return cases;
}
}  // namespace mill::verify
