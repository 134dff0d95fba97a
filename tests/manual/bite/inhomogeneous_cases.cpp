#include "core/base/errors.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/karman_arc.h"
#include "reduce/bite/slab/orowan.h"
#include "reduce/bite/slab/sims.h"
#include "tests/manual/bite/karman_models.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/solvers/moved_bite.h"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace mill::verify {
namespace {
using namespace bite;

constexpr double per_mm = 1e-3;  // forces below are N per mm of width

struct Row {
  double F, T, neutral, slip, peak;
};

std::vector<Check> nine_passes(const Theory theory, const std::array<Row, 9> &table)
{
  std::vector<Check> checks;
  for (int i = 0; i < 9; ++i) {
    const BiteState s    = solve_karman(numbered(i + 1), theory, Arc::rigid, nullptr, without_curves());
    const std::string id = "B" + std::to_string(i + 1);
    checks.push_back(relative(id + " force", "N", s.force, table[i].F, 1e-8));
    checks.push_back(relative(id + " torque", "N mm", s.torque / mm, table[i].T, 1e-7));
    checks.push_back(printed(id + " forward slip", "-", s.forward_slip, table[i].slip, 5e-6));
    if (table[i].peak > 0) {
      const double R = numbered(i + 1).roll_radius;
      checks.push_back(printed(id + " neutral over entry angle", "-",
                               std::asin(s.neutral_position / R) / std::asin(s.arc_length / R), table[i].neutral,
                               5e-6));
      checks.push_back(printed(id + " peak pressure", "MPa", s.peak_pressure / MPa, table[i].peak, 5e-5));
    }
  }
  return checks;
}

std::vector<Check> homogeneous_passes()
{
  return nine_passes(Theory::karman, {{{989.45598, 11779.8865, 0.34258, 0.06959, 57.2755},
                                       {1372.68777, 16387.0759, 0.38903, 0.08972, 83.5589},
                                       {6261.47865, 282405.0151, 0.33986, 0.02036, 75.9915},
                                       {5352.92209, 142586.3458, 0.34304, 0.03728, 119.4673},
                                       {6092.28122, 28673.8727, 0.30783, 0.03149, 696.2352},
                                       {4573.24421, 12722.1963, 0.36187, 0.05608, 1090.0974},
                                       {3078.70386, 15287.9808, 0.24923, 0.00659, 319.1529},
                                       {7661.53871, 41756.0891, 0.31196, 0.03234, 811.8198},
                                       {2952.39612, 67396.6971, 0.42109, 0.00665, 67.9387}}});
}

std::vector<Check> inhomogeneous_passes()
{
  return nine_passes(Theory::orowan, {{{937.91693, 11189.5843, 0, 0.06932, 0},
                                       {1235.50022, 14685.2908, 0, 0.09511, 0},
                                       {5641.16406, 253877.3861, 0, 0.02000, 0},
                                       {4896.26060, 130433.9537, 0, 0.03683, 0},
                                       {6073.50784, 28574.6896, 0, 0.03148, 0},
                                       {4561.02048, 12687.6208, 0, 0.05606, 0},
                                       {3052.94726, 15151.1909, 0, 0.00658, 0},
                                       {7634.72994, 41607.4348, 0, 0.03232, 0},
                                       {2695.12937, 61398.7503, 0, 0.00658, 0}}});
}

std::vector<Check> parabolas()
{
  return {relative("B1", "N", force_on_parabola(1, true), 984.35127, 1e-8),
          relative("B2", "N", force_on_parabola(2, true), 1361.81396, 1e-8),
          relative("B3, mu p without limit", "N", force_on_parabola(3, false), 6132.84360, 1e-8),
          relative("B8", "N", force_on_parabola(8, true), 7656.17862, 1e-8)};
}

std::vector<Check> sims_against_slices()
{
  KarmanOptions options = without_curves();
  options.small_angles  = true;
  const double slices   = solve_karman(numbered(2), Theory::orowan, Arc::rigid, nullptr, options).force;
  const auto factor     = [](const int i) {
    const RollBite b  = numbered(i);
    const SimsForce s = sims_force(b.roll_radius, b.roll_radius, b.strip.entry_thickness, b.strip.exit_thickness,
                                       b.strip.flow_stress.k);
    return std::array<double, 2>{s.force * per_mm, s.factor};
  };
  return {relative("B2 by slices, w = pi/4, small angles", "N", slices, 1227.96177, 1e-8),
          relative("B2 by slices against the closed form", "N", slices, factor(2)[0], 1e-9),
          printed("B2 force factor, closed form", "-", factor(2)[1], 1.747256, 5e-7),
          relative("B3 closed form", "N", factor(3)[0], 5322.24080, 1e-8),
          relative("B4 closed form", "N", factor(4)[0], 5015.60433, 1e-8),
          relative("B7 closed form", "N", factor(7)[0], 3109.17515, 1e-8)};
}

/// w by the midpoint rule in u, theta = phi sin(u)/a, which has no singularity left: an independent evaluation.
double wedge_by_quadrature(const double a, const double phi)
{
  const int n      = 20000;
  const double end = std::asin(a), h = end / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) * h;
    sum += std::cos(u) * std::cos(u) * std::cos(phi * std::sin(u) / a);
  }
  return phi / (a * std::sin(phi)) * sum * h;
}

std::vector<Check> wedge()
{
  const auto parallel       = [](const double a) { return 0.5 * (std::sqrt(1 - a * a) + std::asin(a) / a); };
  std::vector<Check> checks = {relative("w(0, 0.2)", "-", wedge_factor(0, 0.2).value, 1, 1e-12),
                               relative("w(1, 0)", "-", wedge_factor(1, 0).value, M_PI / 4, 1e-14)};
  for (const double a : {0.1, 0.5, 0.9})
    checks.push_back(relative(fmt::format("w({:g}, 1e-4) against parallel plates", a), "-",
                              wedge_factor(a, 1e-4).value, parallel(a), 1e-8));
  for (const double a : {0.1, 0.24, 0.26, 0.7, 1.0})
    for (const double phi : {0.05, 0.3, 0.8})
      checks.push_back(relative(fmt::format("w({:g}, {:g}) against quadrature", a, phi), "-",
                                wedge_factor(a, phi).value, wedge_by_quadrature(a, phi), 1e-8));
  return checks;
}

std::vector<Check> idle_rolls()
{
  RollBite b               = one_mm_wide({"idle", 210, 8, 7, 28, 0, 0, 0, 0, 0});
  const IdleDrawing circle = draw_through_idle_rolls(b);
  const double homogeneous = 28 * MPa * std::log(8.0 / 7);
  KarmanOptions options;
  options.small_angles       = true;
  const IdleDrawing parabola = draw_through_idle_rolls(b, options);
  const double R = 0.21, h2 = 7 * mm, k = 28 * MPa, L = std::sqrt(R * mm);
  const double closed = k * L - 2 * k * (L - std::sqrt(R * h2) * std::atan(L / std::sqrt(R * h2)));
  return {relative("drawing stress, circle", "MPa", circle.exit_tension / MPa, homogeneous / MPa, 1e-10),
          relative("drawing stress, parabola", "MPa", parabola.exit_tension / MPa, 3.73888, 1e-6),
          relative("force, parabola", "N", parabola.force, 370.1228, 1e-6),
          relative("force, parabola, against the closed form", "N", parabola.force, closed * mm, 1e-10)};
}

/// Derivative against differences of the fourth order.
double difference(const std::function<double(double)> &f, const double step)
{
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

double moved_force(const RollBite &bite, const Theory theory, const Input which, const double by)
{
  const RollBite b      = moved_bite(bite, which, by);
  KarmanOptions options = without_curves();
  options.derivatives   = false;
  const CircularBite c  = solve_on_circle(b, theory, b.roll_radius, b.strip.friction.coefficient, options);
  return c.force.value * b.strip.width;
}

std::vector<Check> derivatives()
{
  std::vector<Check> checks;
  const struct {
    Input which;
    const char *name;
    double step;
  } inputs[] = {{Input::entry_thickness, "entry thickness", 1e-3},  // steps relative to the value that follows
                {Input::exit_thickness, "exit thickness", 1e-3},   {Input::friction, "friction", 1e-3},
                {Input::flow_stress, "flow stress", 1e-3},         {Input::arc_radius, "arc radius", 1e-3},
                {Input::entry_tension, "entry tension", 1e-3},     {Input::exit_tension, "exit tension", 1e-3}};
  for (const Theory theory : {Theory::karman, Theory::orowan})
    for (const int i : {1, 3, 6}) {
      const RollBite b  = numbered(i);
      const BiteState s = solve_karman(b, theory, Arc::rigid, nullptr, without_curves());
      const Strip &t    = b.strip;
      for (const auto &input : inputs) {
        const double size = input.which == Input::friction      ? t.friction.coefficient
                            : input.which == Input::flow_stress ? 1
                            : input.which == Input::arc_radius  ? b.roll_radius
                            : input.which == Input::entry_tension || input.which == Input::exit_tension
                                ? t.flow_stress.k
                                : t.entry_thickness - t.exit_thickness;
        const double slope =
            difference([&](const double x) { return moved_force(b, theory, input.which, x); }, input.step * size);
        checks.push_back(relative(std::string(theory == Theory::karman ? "Karman " : "Orowan ") + "B" +
                                      std::to_string(i) + ", d ln F by " + input.name,
                                  "1/size", by(s.force_by, input.which) * size / s.force, slope * size / s.force,
                                  1e-6));
      }
    }
  const BiteState demo = solve_karman(numbered(1), Theory::karman, Arc::rigid, nullptr, without_curves());
  checks.push_back(
      relative("B1 dF/dk against F/k", "mm", by(demo.force_by, Input::flow_stress) / 28, demo.force / 28, 1e-10));
  checks.push_back(printed("B1 dF/dh1", "N/mm", by(demo.force_by, Input::entry_thickness) * mm, 184.332, 5e-4));
  checks.push_back(printed("B1 dF/ds1", "N/MPa", by(demo.force_by, Input::entry_tension) * MPa, -27.967, 5e-4));
  checks.push_back(printed("B1 dF/ds2", "N/MPa", by(demo.force_by, Input::exit_tension) * MPa, -12.474, 5e-4));
  checks.push_back(printed("B1 dF/dmu", "N", by(demo.force_by, Input::friction), 2614.41, 5e-3));
  return checks;
}

std::vector<Check> plastic_slopes()
{
  const std::array<std::array<double, 2>, 8> table = {{{247.253, 226.009},
                                                       {401.560, 386.809},
                                                       {172.390, 151.743},
                                                       {320.766, 284.092},
                                                       {9468.07, 9431.78},
                                                       {26400.5, 26293.4},
                                                       {1516.19, 1501.13},
                                                       {8400.78, 8362.82}}};
  std::vector<Check> checks;
  for (int i = 1; i <= 8; ++i)
    for (const Theory theory : {Theory::karman, Theory::orowan}) {
      const BiteState s = solve_karman(numbered(i), theory, Arc::rigid, nullptr, without_curves());
      checks.push_back(relative("B" + std::to_string(i) + (theory == Theory::karman ? " Karman" : " Orowan"),
                                "N/mm", -by(s.force_by, Input::exit_thickness) * mm,
                                table[i - 1][theory == Theory::karman ? 0 : 1], 1e-5));
    }
  const BiteState sims = solve_karman(numbered(2), Theory::sims, Arc::rigid, nullptr, without_curves());
  checks.push_back(relative("B2 Sims", "N/mm", -by(sims.force_by, Input::exit_thickness) * mm, 384.227, 1e-5));
  return checks;
}

std::vector<Check> following_slopes()
{
  std::vector<Check> checks;
  const struct {
    int pass;
    double slope;
  } table[] = {{5, 11201.6}, {6, 68490.6}, {8, 9420.8}};
  for (const auto &row : table) {
    const RollBite b  = numbered(row.pass);
    const BiteState s = solve_karman(b, Theory::karman, Arc::hitchcock, nullptr, without_curves());
    checks.push_back(relative("B" + std::to_string(row.pass) + ", R' following", "N/mm",
                              -s.force_by_exit_following * mm, row.slope, 1e-5));
    const double slope = difference(
        [&](const double x) {
          RollBite moved = b;
          moved.strip.exit_thickness += x;
          return solve_karman(moved, Theory::karman, Arc::hitchcock, nullptr, without_curves()).force;
        },
        1e-4 * (b.strip.entry_thickness - b.strip.exit_thickness));
    checks.push_back(relative("B" + std::to_string(row.pass) + " against differences of flattened states", "N/mm",
                              -s.force_by_exit_following * mm, -slope * mm, 1e-6));
  }
  return checks;
}

std::vector<Check> demo_stiffnesses()
{
  const RollBite b      = numbered(1);
  const BiteState hom   = solve_karman(b, Theory::karman, Arc::rigid, nullptr, without_curves());
  const BiteState oro   = solve_karman(b, Theory::orowan, Arc::rigid, nullptr, without_curves());
  const BiteState flat  = solve_karman(b, Theory::karman, Arc::hitchcock, nullptr, without_curves());
  const BiteStiffness k = slab_stiffness(b, hom), i = slab_stiffness(b, oro), f = slab_stiffness(b, flat);
  const double unit = kN;  // N/m per mm of width is kN/mm per m of width, times a million
  return {relative("plastic slope, Karman", "kN/mm per m", k.plastic_slope / unit, 247.253, 1e-5),
          relative("plastic slope, Orowan", "kN/mm per m", i.plastic_slope / unit, 226.009, 1e-5),
          relative("plastic slope, Karman, R' following", "kN/mm per m", f.plastic_slope_following / unit, 248.860,
                   1e-5),
          relative("flattening of one roll", "kN/mm per m", k.flattening / unit, 9.6641e4, 1e-5),
          relative("combined, Karman", "kN/mm per m", k.combined / unit, 245.994, 1e-5),
          relative("combined, Orowan", "kN/mm per m", i.combined / unit, 224.957, 1e-5)};
}

std::vector<Check> flattened_passes()
{
  const struct {
    int pass;
    double F, ratio, F_orowan, ratio_orowan;
  } table[] = {{1, 995.0223, 1.00741, 942.7662, 1.00702},
               {2, 1383.5089, 1.01031, 1244.6028, 1.00927},
               {5, 7254.1308, 1.32427, 7226.5339, 1.32304},
               {6, 8817.8860, 2.31391, 8751.2598, 2.30399},
               {8, 9600.6612, 1.42917, 9556.3843, 1.42719}};
  std::vector<Check> checks;
  for (const auto &row : table)
    for (const Theory theory : {Theory::karman, Theory::orowan}) {
      const RollBite b     = numbered(row.pass);
      const BiteState s    = solve_karman(b, theory, Arc::hitchcock, nullptr, without_curves());
      const bool first     = theory == Theory::karman;
      const std::string id = "B" + std::to_string(row.pass);
      checks.push_back(relative(id + (first ? " Karman" : " Orowan") + " force", "N", s.force,
                                first ? row.F : row.F_orowan, 1e-7));
      checks.push_back(printed(id + (first ? " Karman" : " Orowan") + " R'/R", "-",
                               s.flattened_radius / b.roll_radius, first ? row.ratio : row.ratio_orowan, 5e-6));
    }
  return checks;
}

/// Pass 1 with a harder strip: flattened more than five times.
std::vector<Check> beyond_five()
{
  RollBite b =
      one_mm_wide({"cluster 5", 34.8, 0.105, 0.095, 1532.1353841, 0.052686855390355405, 414.9, 416.9, 0, 0});
  b.roll            = {2.1e11, 0.3, 7850};
  const BiteState s = solve_karman(b, Theory::karman, Arc::hitchcock, nullptr, without_curves());
  double notes      = 0;
  for (const Warning &note : s.notes)
    notes += note.id == WarningId::bite_flattening;
  double refused                    = 0;
  RollBite harder                   = b;
  harder.strip.flow_stress.k        = 2.0e9;
  harder.strip.friction.coefficient = 0.1;
  try {
    solve_karman(harder, Theory::karman, Arc::hitchcock, nullptr, without_curves());
  } catch (const SolverError &) {
    refused = 1;
  }
  return {{"R'/R above 5", "-", s.flattened_radius / b.roll_radius, 5, 0, Judged::at_least},
          {"notes that say so", "-", notes, 1, 0},
          {"no flattened radius at all: reported as an error", "-", refused, 1, 0}};
}

/// Full equation of slices on given arcs: working conditions of a cold tandem mill, passes of a cluster mill.
std::vector<Check> cold_conditions()
{
  const auto condition = [](const double h1, const double h2, const double s1, const double s2, const double R,
                            const double mu) {
    RollBite b                   = one_mm_wide({"tandem", 300, h1, h2, 829.642590, mu, s1, s2, 0.00817, 0});
    b.strip.width                = 1.206;
    b.strip.initial_thickness    = 3 * mm;
    b.strip.flow_stress.law      = FlowStressLaw::reduction_power;
    b.strip.flow_stress.eps0     = 0.00817;
    b.strip.flow_stress.n        = 0.3;
    b.strip.friction.shear_limit = not_given;
    KarmanOptions options        = without_curves();
    options.small_angles         = true;
    const CircularBite s         = solve_on_circle(b, Theory::karman, R, mu, options);
    b.roll                       = {2.1e11, 0.3, 7850};
    const BiteState flattened    = solve_karman(b, Theory::karman, Arc::hitchcock, nullptr, options);
    return std::array<double, 3>{s.force.value * b.strip.width, s.neutral_position, flattened.force};
  };
  const auto one = condition(0.755, 0.568, 156, 197, 0.5424180615984966, 0.023968189622223662);
  const auto two = condition(0.789, 0.577, 180, 189, 0.5262338200786073, 0.02832038583977992);
  return {relative("condition 1, force", "kN", one[0] / kN, 8095.1915114741465, 1e-8),
          relative("condition 1, neutral point", "mm", one[1] / mm, 3.003188486910883, 1e-8),
          relative("condition 1, force with its own flattened radius", "kN", one[2] / kN, 8034.624137427143, 1e-7),
          relative("condition 2, force with its own flattened radius", "kN", two[2] / kN, 8422.838570251536, 1e-7),
          relative("condition 2, force", "kN", two[0] / kN, 8508.435325845541, 1e-8),
          relative("condition 2, neutral point", "mm", two[1] / mm, 2.932440016814648, 1e-8)};
}

std::vector<Check> cluster_passes()
{
  const struct {
    const char *name;
    double h1, h2, T1, T2, mu, R, k, parabola, circle;
  } table[] = {{"pass 1, R", 0.26, 0.18, 38e3, 35e3, 0.05952415389897671, 0.0348, 1501051462.502769,
                1118483.9400807833, 1119303.6875113235},
               {"pass 1, R'", 0.26, 0.18, 38e3, 35e3, 0.05952415389897671, 0.05662388047537422, 1180364655.4941888,
                1116501.7918000338, 1117126.5904804554},
               {"pass 3, R", 0.145, 0.12, 31e3, 28e3, 0.057328662702298125, 0.0348, 3141593760.657045,
                1501096.3501128773, 1501712.9530728548},
               {"pass 3, R'", 0.145, 0.12, 31e3, 28e3, 0.057328662702298125, 0.1264755062756487,
                1589191080.7441237, 1496517.7442188838, 1496803.1154753016},
               {"pass 5, R", 0.105, 0.095, 22e3, 20e3, 0.052686855390355405, 0.0348, 4216465803.6354003,
                1300818.0107525003, 1301130.3526350704},
               {"pass 5, R'", 0.105, 0.095, 22e3, 20e3, 0.052686855390355405, 0.2328117935814443,
                1532135384.1079879, 1298278.1505589874, 1298381.404513421}};
  std::vector<Check> checks;
  for (const auto &row : table) {
    RollBite b                   = one_mm_wide({"cluster", 34.8, row.h1, row.h2, row.k / MPa, row.mu, 0, 0, 0, 0});
    b.strip.width                = 0.505;
    b.strip.entry_tension        = row.T1 / (0.505 * row.h1 * mm);
    b.strip.exit_tension         = row.T2 / (0.505 * row.h2 * mm);
    b.strip.friction.shear_limit = not_given;
    KarmanOptions options        = without_curves();
    const double circle   = solve_on_circle(b, Theory::karman, row.R, row.mu, options).force.value * b.strip.width;
    options.small_angles  = true;
    const double parabola = solve_on_circle(b, Theory::karman, row.R, row.mu, options).force.value * b.strip.width;
    checks.push_back(relative(std::string(row.name) + ", parabola", "kN", parabola / kN, row.parabola / kN, 1e-7));
    checks.push_back(relative(std::string(row.name) + ", circle", "kN", circle / kN, row.circle / kN, 1e-7));
  }
  return checks;
}
}  // namespace

std::vector<Case> inhomogeneous_cases()
{
  const char *tables =
      "independent integration to 1e-10 of the same equations; reference tables of the nine passes, printed "
      "digits (B1 is the pass of the demo stand, B2 the same sticking, B3-B4 and B9 hot, B5-B8 cold)";
  const char *ode =
      "1e-8 on the force, 1e-7 on the torque: the reference was integrated to 1e-10 and printed with "
      "nine to ten digits; half a unit of the last digit where fewer are printed";
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const char *problem, const char *source,
                       const char *reason, const std::function<std::vector<Check>()> &run) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("karman-passes", "regression",
      "BI-01, homogeneous: horizontal equilibrium of slices on the circular arc, Coulomb friction limited by the "
      "shear yield stress, integrated from both ends by an extrapolated midpoint rule of order 12",
      tables, ode, homogeneous_passes);
  add("orowan-passes", "regression",
      "BI-01, inhomogeneous: the same with the stress of a plastic wedge; the pressure is implicit in every slice",
      tables, ode, inhomogeneous_passes);
  add("karman-parabola", "regression",
      "the homogeneous equation on a parabola, without the friction's share of the vertical force: what Bland and "
      "Ford start from",
      tables, "1e-8: printed digits", parabolas);
  add("sims", "verification",
      "BI-02: inhomogeneous slices sticking all along, w = pi/4, small angles, against Sims' closed form",
      "the closed form solves the same equation; values of an independent evaluation",
      "1e-8: printed digits, the integration is good to 1e-11; factors to their last digit", sims_against_slices);
  add("orowan-wedge", "unit",
      "BI-03: mean horizontal stress of a plastic wedge, by moments that follow from each other, against its "
      "limits and against a midpoint rule of 20 000 points in the angle that takes the singularity away",
      "limits in closed form; quadrature", "1e-8: the midpoint rule is good to 1e-9; the limits to rounding",
      wedge);
  add("idle-rolls", "verification",
      "BI-05: strip drawn 8 -> 7 mm through idle frictionless rolls of 420 mm: a single branch from entry to exit",
      "homogeneous work: k ln(h1/h2); force in closed form on the parabola",
      "1e-6 against printed digits, 1e-10 against the closed forms (integration 1e-11)", idle_rolls);
  add("slab-derivatives", "verification",
      "BI-15: derivatives of the integrated force by all inputs, from the same steps in numbers with derivatives "
      "and a moving neutral point, against differences of the fourth order",
      "differences of the product's own force; sensitivities of B1 from an independent program; dF/dk = F/k by "
      "scaling",
      "1e-6: the truncation of the differences with steps of 1e-3 (the kink of the friction's limit included); "
      "1e-10 for the identity; printed digits",
      derivatives);
  add("slab-plastic-slopes", "regression", "BI-15: -dF/dh2 of eight passes by both theories, arc held",
      "differences of the fourth order by an independent program", "1e-5: printed with six digits",
      plastic_slopes);
  add("slab-following-slopes", "regression",
      "BI-15: -dF/dh2 with Hitchcock's radius following the force, at the flattened state of each pass",
      "differences of flattened states, by an independent program and by the product",
      "1e-5: printed with six digits; 1e-6 against own differences (truncation)", following_slopes);
  add("demo-slope-integrated", "regression",
      "BI-16: the stiffnesses called K4 of the demo pass, homogeneous and inhomogeneous, 1 m wide",
      "independent program; flattening and series in closed form", "1e-5: printed with six digits",
      demo_stiffnesses);
  add("slab-flattened", "regression", "BI-17: both theories with Hitchcock's radius, first root",
      "fixed point iterated to 1e-11 by an independent program", "1e-7 on the force, printed digits on R'/R",
      flattened_passes);
  add("slab-beyond-five", "unit",
      "BI-22: fifth pass of a cluster mill, flattened more than five times, is flagged; a harder strip under more "
      "friction has no flattened radius and is an error",
      "no number: what has to be said", "exact", beyond_five);
  add("karman-cold-conditions", "regression",
      "CH-04: two working conditions of a cold tandem mill, hardening by reduction, homogeneous slices on the "
      "parabola at given radius and friction, no limit of the friction stress",
      "independent integration to 1e-11 (entries slab.condition_1, slab.condition_2)",
      "1e-8: integration on both sides; 1e-7 where the radius is iterated as well", cold_conditions);
  add("karman-cluster-passes", "regression",
      "CL-04: three passes of a cluster mill with the flow stress that fits their force, homogeneous slices on "
      "parabola and circle",
      "independent integration (entries tuned_k.pass_1, _3, _5: slab_parabola, slab_arc)",
      "1e-7: integration tolerance of the reference", cluster_passes);
  return cases;
}
}  // namespace mill::verify
