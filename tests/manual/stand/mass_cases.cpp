#include "reduce/bearing/rigid_rings.h"
#include "reduce/chain/beam_shapes.h"
#include "reduce/chain/equivalent_mass.h"
#include "reduce/chain/line_contact.h"
#include "reduce/chain/timoshenko_beam.h"
#include "reduce/stand/mass_breakdown.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modes.h"
#include "tests/manual/stand/mass_models.h"
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace mill::verify {
namespace {
using namespace reduce;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Equivalent mass of a simply supported uniform Euler beam, load over |x| <= half_load of the half span 1.
double uniform_beam_ratio(const double half_load)
{
  const BeamSection section{1, infinite};
  const SteppedBeam beam{1, 1, half_load, section, section};
  const auto shape = [&](double x) { return deflection(beam, x); };
  return equivalent_mass(shape, {{0, half_load, 1}, {half_load, 1, 1}}, {}, deflection(beam, 0));
}

std::vector<Check> uniform_beam()
{
  return {relative("even load: equivalent / real mass", "-", uniform_beam_ratio(1), 3968. / 7875, 1e-6),
          relative("central load: equivalent / real mass", "-", uniform_beam_ratio(1e-4), 17. / 35, 1e-6)};
}

void add_backup_shape(std::vector<Check> &checks, const std::string &name, SteppedBeam beam, const bool shear,
                      const double K_ZW, const std::array<double, 11> &reference)
{
  if (!shear)
    beam.barrel.shear = beam.neck.shear = infinite;
  checks.push_back(relative(name + ": K_ZW", "N/m", 1 / mid_flexibility(beam), K_ZW, 1e-8));
  for (std::size_t i = 0; i < reference.size(); ++i)
    checks.push_back({fmt::format("{}: w({:.1f} a) / w(0)", name, 0.1 * double(i)), "-",
                      deflection(beam, 0.1 * double(i) * beam.half_span) / deflection(beam, 0), reference[i], 1e-8,
                      Judged::absolute});
}

std::vector<Check> roll_shapes()
{
  std::vector<Check> checks;
  const FourHigh stand = demo_stand();
  add_backup_shape(checks, "backup roll", backup_beam(stand), true, 68123188538.1921,
                   {1.0, 0.9920605137587369, 0.9683622870395873, 0.9292660158564701, 0.8753728602325842,
                    0.8075244442004073, 0.7128028973926656, 0.560703204336025, 0.3862311987437909,
                    0.19684431812782774, 0.0});
  add_backup_shape(checks, "backup roll without shear", backup_beam(stand), false, 123065723104.86852,
                   {1.0, 0.9911527448227584, 0.9648281804953351, 0.9216779106306335, 0.8627879412501598,
                    0.7896786807840221, 0.7024251444325678, 0.5739708246166906, 0.40510053369315785,
                    0.20928626203118816, 0.0});
  const auto add_work = [&](const double width, const std::array<double, 3> &reference) {
    const FoundationShape foundation =
        foundation_shape({0.7, width / 2, 2.8708451127e10, round_section(0.42, stand.steel).bending});
    const std::array<double, 3> x{0, 0.7, 1};
    for (std::size_t i = 0; i < 3; ++i)
      checks.push_back(relative(fmt::format("work roll, strip {:.1f} m: w1 at {:.1f} m", width, x[i]), "m/N",
                                deflection(foundation, x[i]), reference[i], 1e-8));
  };
  add_work(0.3, {4.0041670647707874e-11, 2.769929987360806e-12, -1.7820046029435426e-11});
  add_work(1.0, {3.13127287410884e-11, 1.3814207085547785e-11, 2.545848975868458e-12});
  add_work(1.4, {2.4880677509479728e-11, 2.4880677509479728e-11, 2.4880677509479728e-11});
  return checks;
}

/// First frequency of the backup roll (no chocks, no bearings) with rigid bearing centres, by beam elements.
double supported_roll_frequency(const int elements)
{
  const FourHigh stand = demo_stand();
  const Roll &roll     = stand.backup_roll;
  const auto per_meter = [&](const double d) { return stand.steel.density * M_PI / 4 * d * d; };
  const double h = roll.barrel_length / 2, a = roll.bearing_span / 2;
  const SymmetricBeam beam = symmetric_beam(
      {{h, elements, round_section(roll.barrel_diameter, stand.steel), per_meter(roll.barrel_diameter)},
       {a - h, elements, round_section(roll.neck_diameter, stand.steel), per_meter(roll.neck_diameter)}});
  const Eigen::Index n = beam.z.size() - 1;  // the last node is held
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      beam.K.topLeftCorner(n, n), Eigen::MatrixXd(beam.mass.head(n).asDiagonal()), Eigen::EigenvaluesOnly);
  return std::sqrt(modes.eigenvalues()[0]) / (2 * M_PI);
}

double rayleigh_frequency(const double flexibility)
{
  const FourHigh stand   = demo_stand();
  const SteppedBeam beam = backup_beam(stand);
  const auto shape       = [&](double x) { return deflection(beam, x); };
  const auto per_meter   = [&](const double d) { return stand.steel.density * M_PI / 4 * d * d; };
  const double mass =
      2 * equivalent_mass(shape,
                          {{0, beam.half_barrel, per_meter(stand.backup_roll.barrel_diameter)},
                           {beam.half_barrel, beam.half_span, per_meter(stand.backup_roll.neck_diameter)}},
                          {}, flexibility);
  return std::sqrt(1 / (flexibility * mass)) / (2 * M_PI);
}

std::vector<Check> roll_on_supports()
{
  const SteppedBeam beam = backup_beam(demo_stand());
  const double elements = supported_roll_frequency(48), mean = rayleigh_frequency(mean_flexibility(beam));
  return {relative("beam elements", "Hz", elements, 312.0, 1e-3),
          relative("Rayleigh, mean reference", "Hz", mean, 312.1, 1e-3),
          relative("Rayleigh / beam elements", "-", mean / elements, 1, 1e-3),
          relative("48 elements per span / 96", "-", elements / supported_roll_frequency(96), 1, 1e-4),
          relative("Rayleigh, mid-span reference", "Hz", rayleigh_frequency(mid_flexibility(beam)), 326.2, 1e-3)};
}

void add_masses(std::vector<Check> &checks, const std::string &name, const LumpedModel &model,
                const std::array<double, 4> &reference)
{
  for (std::size_t i = 0; i < 4; ++i)
    checks.push_back(
        relative(fmt::format("{}: M{}", name, i + 2), "kg", model.M[i + 1].value, reference[i], 1e-6));
}

std::vector<Check> demo_masses()
{
  std::vector<Check> checks;
  FourHigh stand          = demo_stand();
  const LumpedStand chain = demo_chain(stand);
  const std::array<double, 6> M{9320, 59724.995217401956, 1875.2537533879936, 3069.20607251703, 42315.96645247819,
                                4660};
  const std::array<double, 7> K{6314120275.822302,  10233315911.370417, 40191831577.696884, 0,
                                40191831577.696884, 29270165530.69475,  6880668597.749182};
  for (std::size_t i = 0; i < 6; ++i)
    checks.push_back(relative(fmt::format("M{}", i + 1), "kg", chain.model.M[i].value, M[i], 1e-6));
  for (std::size_t i = 0; i < 7; ++i)
    if (i != 3)
      checks.push_back(relative(fmt::format("K{}", i + 1), "N/m", chain.model.K[i].value, K[i], 1e-6));
  const Flexibilities &u = chain.flexibility;
  checks.push_back(relative("u of the cylinder", "m/N", u.cylinder, 2.1393074581430745e-10, 1e-6));
  checks.push_back(relative("u of the upper chock", "m/N", u.chock_upper, 2.2193074581430745e-10, 1e-6));
  checks.push_back(relative("u of the upper bearings", "m/N", u.bearing_upper, 2.4141593692244707e-10, 1e-6));
  checks.push_back(relative("u of the upper backup roll", "m/N", u.roll_upper, 2.560952263312123e-10, 1e-6));
  checks.push_back(relative("u of the lower bearings", "m/N", u.bearing_lower, 1.6481990470372274e-10, 1e-6));
  checks.push_back(relative("u of the lower backup roll", "m/N", u.roll_lower, 1.7949919411248797e-10, 1e-6));
  checks.push_back(relative("K_ZW, mid-span", "N/m", chain.K_ZW.value, 68123188538.1921, 1e-6));
  checks.push_back(
      relative("1 / w1(0)", "N/m", 1 / (chain.f1_upper.value[0] - u.roll_upper), 31935894449.460903, 1e-6));

  stand.dynamics.mass_reference = MassReference::mean;
  const LumpedStand mean        = demo_chain(stand);
  checks.push_back(relative("mean reference: K_ZW", "N/m", mean.K_ZW.value, 74401862225.35272, 1e-6));
  add_masses(checks, "mean reference", mean.model,
             {60307.00971880717, 1874.4503936806407, 3065.0535859077613, 42906.133335222534});

  RollerBearing bearing;
  bearing.name            = "backup";
  bearing.type            = BearingType::four_row_cylindrical;
  bearing.rollers_per_row = 32;
  bearing.roller_length   = 0.11;
  bearing.roller_diameter = 0.075;
  bearing.roller_law      = OneRollerLaw::palmgren;
  checks.push_back(relative("K_Zy, two bearings at 488 kN each", "N/m",
                            2 * bearing::solve_bearing(bearing, 976217.5 / 2).tangent, 102286583389.26591, 1e-6));
  checks.push_back(relative("K3, line contact at 976.2 kN", "N/m",
                            line_contact({0.42, 1.45, 1.4, stand.steel}, 976217.5).tangent, 40191831577.696884,
                            1e-6));
  return checks;
}

/// M2..M5 with backup rolls that do not shear; K_ZW follows, all other springs stay.
std::array<double, 4> masses_without_shear()
{
  const FourHigh stand = demo_stand();
  SteppedBeam beam     = backup_beam(stand);
  beam.barrel.shear = beam.neck.shear = infinite;
  const PathSprings path{102286583389.26591, 102286583389.26591, 1 / mid_flexibility(beam)};
  const SeriesSprings series = series_springs(stand.frame, path);
  const Flexibilities u      = flexibilities(stand.frame, path, series.K1, series.K7);
  const Roll &work           = stand.work_roll;
  const FoundationShape foundation =
      foundation_shape({0.7, 0.5, 40191831577.696884 / 1.4, round_section(0.42, stand.steel).bending});
  return {upper_backup_mass(stand, beam, u),
          work_roll_mass(stand, foundation, beam, u.roll_upper, work.chock_mass_upper),
          work_roll_mass(stand, foundation, beam, u.roll_lower, work.chock_mass_lower),
          lower_backup_mass(stand, beam, u)};
}

std::vector<Check> demo_sensitivity()
{
  std::vector<Check> checks;
  const auto euler                     = masses_without_shear();
  const std::array<double, 4> expected = {61819.472531633386, 1881.19810463792, 3081.6145875589077,
                                          44015.9469706093};
  for (std::size_t i = 0; i < 4; ++i)
    checks.push_back(
        relative(fmt::format("backup rolls without shear: M{}", i + 2), "kg", euler[i], expected[i], 1e-6));
  FourHigh stand                   = demo_stand();
  stand.work_roll.chock_mass_upper = 880;
  add_masses(checks, "the same chocks above and below", demo_chain(stand).model,
             {59724.995217401956, 3260.582664093945, 3069.20607251703, 42315.96645247819});
  stand             = demo_stand();
  stand.strip.width = 1.4;
  add_masses(checks, "strip 1.4 m", demo_chain(stand).model,
             {59724.995217401956, 2041.2579789615222, 3728.4813946343534, 42315.96645247819});
  stand               = demo_stand();
  stand.steel.density = 7850;
  add_masses(checks, "density 7850 kg/m3", demo_chain(stand).model,
             {60256.81813747188, 1909.0246440539743, 3101.93378765933, 42840.72419972767});
  stand                             = demo_stand();
  stand.backup_roll.barrel_diameter = 1.3;
  add_masses(checks, "backup rolls 1300 mm", demo_chain(stand).model,
             {55231.214047448775, 1866.6166359267725, 3044.10039741104, 38014.52067642266});
  return checks;
}

std::vector<Check> chain_identity()
{
  std::vector<Check> checks;
  FourHigh stand    = demo_stand();
  LumpedModel model = demo_chain(stand).model;
  model.K[3].value  = 3e8;
  for (const FrameForm frame : every<FrameForm>()) {
    const SixMasses six = six_masses(chain_stand(model, frame));
    double M = 0, K = 0;
    for (std::size_t i = 0; i < 6; ++i)
      M = std::max(M, std::abs(six.M[i] / model.M[i].value - 1));
    for (std::size_t i = 0; i < 7; ++i)
      K = std::max(K, std::abs(six.K[i] / model.K[i].value - 1));
    checks.push_back(
        {word_of(frame) + std::string(" frame: largest change of a mass"), "-", M, 0, 1e-12, Judged::absolute});
    checks.push_back(
        {word_of(frame) + std::string(" frame: largest change of a spring"), "-", K, 0, 1e-12, Judged::absolute});
  }
  const std::array<double, 6> with_bite{40.218704980820945, 55.48258446111834, 218.3271841342221,
                                        456.7217161883587,  600.4666791187321, 751.0374335525133};
  const StandModes modes = stand_modes(chain_stand(model));
  for (std::size_t i = 0; i < 6; ++i)
    checks.push_back(relative(fmt::format("chain with K4 = 3e8 N/m: mode {}", i + 1), "Hz",
                              modes.frequency[Eigen::Index(i)], with_bite[i], 1e-6));
  const LumpedStand chain = demo_chain(stand);
  double sum              = 0;
  const auto breakdown    = chain_breakdown(stand, chain);
  for (std::size_t i = 0; i < 6; ++i) {
    double parts = 0;
    for (const PartMass &part : breakdown[i].parts)
      parts += part.equivalent;
    sum = std::max(sum, std::abs(parts / chain.model.M[i].value - 1));
  }
  checks.push_back({"sum of the parts of M1..M6 / mass - 1, largest", "-", sum, 0, 1e-12, Judged::absolute});
  return checks;
}
}  // namespace

std::vector<Case> mass_cases()
{
  const std::string document = "independent program, printed to all digits (entries ";
  std::vector<Case> cases;
  const auto add = [&](const std::string &name, const std::string &kind, const std::string &problem,
                       const std::string &source, const std::string &reason,
                       const std::function<std::vector<Check>()> &run) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("mass-uniform-beam", "unit",
      "Uniform simply supported Euler beam: mass at mid-span with the kinetic energy of the static shape, even "
      "load and a load on 1e-4 of the span.",
      "exact, 3968/7875 and 17/35 (static shapes in Rayleigh's quotient)",
      "exact quadrature; the patch of the central load errs at second order of its width", uniform_beam);
  add("mass-roll-shapes", "regression",
      "Backup roll 1450/950 mm on bearing centres 2450 mm apart as a stepped beam with and without shear; work "
      "roll 420 mm on an elastic foundation of 2.87e10 N/m2 under strips of 0.3, 1.0 and 1.4 m.",
      document + "backup_shape.*, work_shape.*)", "closed forms on both sides", roll_shapes);
  add("mass-roll-frequency", "verification",
      "First frequency of the backup roll alone on rigid bearing centres: Timoshenko elements with lumped mass "
      "against Rayleigh's quotient of the static shape.",
      "two independent methods, 312.0 Hz and 312.1 Hz; with mid-span as reference 326.2 Hz",
      "printed with four digits; Rayleigh's quotient errs at second order of the shape. With mid-span instead of "
      "the mean as reference it is 4.6 % high",
      roll_on_supports);
  add("mass-demo-stand", "regression",
      "Demo stand: masses, springs and flexibilities of the chain of six masses, mid-span and mean reference, "
      "with the stiffness of its contacts and bearings.",
      document + "demo.masses, demo.stiffness, demo.flexibilities, demo.mean_reference)",
      "closed forms on both sides. The agreement of these numbers with the published stand comes from fitting the "
      "frame, and is not tested",
      demo_masses);
  add("mass-sensitivity", "regression",
      "M2..M5 of the demo stand with one input changed: no shear, chocks, strip width, density, backup roll "
      "diameter; springs of the path kept.",
      document + "demo.sensitivity)", "closed forms on both sides", demo_sensitivity);
  add("mass-chain-identity", "unit",
      "The chain of the demo stand taken for a detailed model and reduced to six masses gives its own masses and "
      "springs, open and closed frame; its modes with K4 = 3e8 N/m; parts of a mass add up to it.",
      "identity; " + document + "demo.modes.K4_3e8)",
      "rounding of a solve with conditioning 1e3; 1e-6 as the table of the reference asks for eigenvalues",
      chain_identity);
  for (Case &c : stand_model_cases())
    cases.push_back(std::move(c));
  return cases;
}
}  // namespace mill::verify
