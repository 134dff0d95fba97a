#include "core/model/case.h"
#include "dynamics/chatter/run.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

// The stand in time: exact linear motion, the whole bite by CVODE, limit cycles.
namespace mill::verify {
std::vector<Case> chatter_event_cases();

namespace {
using namespace dynamics;
using Eigen::Index;
using Eigen::VectorXd;
using mill::Linearisation;

WorkingPoint condition_2(const double speed, const Linearisation scheme = Linearisation::sequential)
{
  return working_point(film_bite(2, speed), speed, scheme);
}

ChatterRun run_from(const ChatterStandModel &stand, const WorkingPoint &point, const Linearisation scheme,
                    const VectorXd &start, const double duration, const double tolerance = 1e-8)
{
  ChatterRunOptions options;
  options.duration  = duration;
  options.tolerance = tolerance;
  options.contacts  = roll_contacts(stand.structure, point.state.force);
  return nonlinear_run(stand, point, scheme, start, options);
}

// CH-18: scatter of the friction about its mean over [from, to), s.
double fluctuation(const ChatterHistory &h, const double from, const double to)
{
  const auto first = Index(std::lround(from * 1e4)), last = Index(std::lround(to * 1e4));
  const VectorXd part = h.friction.segment(first, last - first);
  return std::sqrt((part.array() - part.mean()).square().mean());
}

std::vector<Check> friction_decay()
{
  const double reference[2][2]  = {{3.1513750516814076e-07, 4.793517235553412e-09},
                                   {6.673949097429629e-07, 6.259468903574866e-07}};
  const ChatterStandModel stand = chatter_stand("D");
  const double speeds[2]        = {17.4, 18.2};
  std::vector<Check> checks;
  for (int i = 0; i < 2; ++i) {
    const auto h   = linear_history(stand, condition_2(speeds[i]).by, displaced_rolls(stand.structure, 1e-7), 3);
    const auto add = [&](const double from, const double to, const double value) {
      checks.push_back(relative(fmt::format("{} m/s, {} to {} s", speeds[i], from, to), "1e-9",
                                1e9 * fluctuation(h, from, to), 1e9 * value, 1e-6));
    };
    add(0.1, 0.6, reference[i][0]);
    add(2.5, 3.0, reference[i][1]);
  }
  return checks;
}

std::vector<Check> state_after_30_ms()
{
  const double reference[8]     = {-5.18940849613618e-09,  -5.360430234551387e-09,  1.5170944547238903e-09,
                                   -1.321764661580568e-08, -1.8643922425587214e-08, -4.071221915633508e-09,
                                   -14060.616481138135,    -2309.770117460081};
  const ChatterStandModel stand = chatter_stand("D");
  const auto h = linear_history(stand, condition_2(18.2).by, displaced_rolls(stand.structure, 1e-7), 0.03);
  std::vector<Check> checks;
  for (int i = 0; i < 6; ++i)
    checks.push_back(relative(stand.structure.labels[i], "nm", 1e9 * h.last[i], 1e9 * reference[i], 1e-6));
  checks.push_back(relative("entry tension", "kPa", 1e-3 * h.last[12], 1e-3 * reference[6], 1e-6));
  checks.push_back(relative("exit tension", "kPa", 1e-3 * h.last[13], 1e-3 * reference[7], 1e-6));
  return checks;
}

// CH-19: relative distance of the last states, displacements and tensions.
std::array<double, 2> distance(const VectorXd &a, const VectorXd &b)
{
  return {(a - b).head(6).norm() / b.head(6).norm(), (a - b).tail(2).norm() / b.tail(2).norm()};
}

std::vector<Check> nonlinear_30_ms()
{
  const double reference[2][2]  = {{0.00033655349985413266, 0.0002730626571004458},
                                   {0.003372669591788216, 0.0027349868271857587}};
  const ChatterStandModel stand = chatter_stand("D");
  const WorkingPoint point      = condition_2(18.2);
  const char *names[2]          = {"displacements", "tensions"};
  std::array<double, 2> result[2];
  std::vector<Check> checks;
  for (const int i : {0, 1}) {
    const VectorXd start = displaced_rolls(stand.structure, i ? 1e-6 : 1e-7);
    result[i] = distance(run_from(stand, point, Linearisation::sequential, start, 0.03, 1e-10).history.last,
                         linear_history(stand, point.by, start, 0.03).last);
    for (const int j : {0, 1})
      checks.push_back(relative(fmt::format("start {} um, {}", i ? 1 : 0.1, names[j]), "1e-6", 1e6 * result[i][j],
                                1e6 * reference[i][j], i ? 5e-5 : 5e-4));
  }
  for (const int j : {0, 1})
    checks.push_back(
        relative(fmt::format("growth of the distance, {}", names[j]), "-", result[1][j] / result[0][j], 10, 0.05));
  return checks;
}

std::vector<Check> small_amplitude()
{
  std::vector<Check> checks;
  const auto compare = [&](const char *name, const Linearisation scheme, const std::string &words) {
    const ChatterStandModel stand = chatter_stand(name);
    const WorkingPoint point      = condition_2(18.2, scheme);
    const VectorXd start          = displaced_rolls(stand.structure, 1e-8);
    const auto a                  = run_from(stand, point, scheme, start, 0.3).history,
               b                  = linear_history(stand, point.by, start, 0.3);
    const auto off = [&](const VectorXd &x, const VectorXd &y) { return (x - y).norm() / y.norm(); };
    checks.push_back(at_most(fmt::format("stand {}, {}: points", name, words), "-",
                             (a.point - b.point).norm() / b.point.norm(), 1e-3));
    checks.push_back(at_most(fmt::format("stand {}, {}: force", name, words), "-", off(a.force, b.force), 1e-3));
    checks.push_back(at_most(fmt::format("stand {}, {}: entry tension", name, words), "-",
                             off(a.entry_tension, b.entry_tension), 1e-3));
  };
  compare("D", Linearisation::sequential, "in sequence");
  compare("D", Linearisation::implicit, "implicit");
  compare("D", Linearisation::frozen_friction, "friction frozen");
  compare("C", Linearisation::sequential, "in sequence");
  compare("B", Linearisation::sequential, "in sequence");
  return checks;
}

// Growth and frequency read off a record against the eigenvalue nearest the frequency of chatter.
std::vector<Check> record_growth()
{
  const ChatterStandModel stand = chatter_stand("D");
  std::vector<Check> checks;
  for (const double speed : {18.0, 18.2, 18.4}) {
    const WorkingPoint point      = condition_2(speed);
    const Eigen::VectorXcd values = eigenvalues(chatter_matrix(stand, point.by));
    const auto nearest   = *std::min_element(values.begin(), values.end(), [](const auto &a, const auto &b) {
      return std::abs(a.imag() - 2 * M_PI * 128) < std::abs(b.imag() - 2 * M_PI * 128);
    });
    const VectorXd start = displaced_rolls(stand.structure, 1e-7);
    const auto add       = [&](const std::string &name, const VectorXd &gap, const double noise) {
      const RecordMode mode = mode_near(record_modes(gap, 1e-4, noise), 128);
      checks.push_back(relative(name + ", growth", "1/s", mode.growth, nearest.real(), 0.01));
      checks.push_back(relative(name + ", frequency", "Hz", mode.frequency, nearest.imag() / (2 * M_PI), 1e-5));
    };
    // The whole bite by CVODE: the linear motion is propagated by the matrix whose eigenvalues these are.
    add(fmt::format("{} m/s", speed),
        run_from(stand, point, Linearisation::sequential, start, 0.6, 1e-9).history.gap, 1e-6);
  }
  return checks;
}

std::vector<Check> whole_second()
{
  const ChatterStandModel stand = chatter_stand("D");
  std::vector<Check> checks;
  const auto add = [&](const std::string &name, const double speed, const double gap) {
    const WorkingPoint point = condition_2(speed);
    const ChatterRun run =
        run_from(stand, point, Linearisation::sequential, critical_mode(stand, point.by, gap), 1);
    checks.push_back(at_most(name + ", missing at the end", "s", 1 - run.end, 1e-12));
  };
  add("18.2 m/s, 0.2 um", 18.2, 2e-7);
  add("19 m/s, limit cycle", 19, 186e-6);
  add("25 m/s, limit cycle", 25, 205e-6);
  return checks;
}
}  // namespace

std::vector<Case> chatter_motion_cases()
{
  const std::string liu = chatter_source, stands = chatter_stands;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("chatter-friction-decay", "regression",
      stands + "Stand D, condition 2, both work rolls moved by 0.1 um: scatter of the friction about its mean, "
               "below and at the critical speed, by the exact step of 0.1 ms.",
      liu + "friction_fluctuation", "1e-6: exact propagation, coefficients of 1e-8.", friction_decay);
  add("chatter-state-30ms", "regression",
      stands + "Stand D, condition 2, 18.2 m/s, both work rolls moved by 0.1 um: linear state after 30 ms.",
      liu + "linear_30ms", "1e-6: exact propagation, coefficients of 1e-8.", state_after_30_ms);
  add("chatter-nonlinear-30ms", "regression",
      stands + "The same with the whole bite: relative distance of the last state from the linear one at starts "
               "of 0.1 and 1 um. First order in the amplitude: a factor of ten.",
      liu + "nonlinear (classical Runge-Kutta steps of 20 us)",
      "5e-4 and 5e-5 of the distance: the steps of the reference err by some 5e-8 of the motion, as it is seen "
      "in both rows; 5 % on the factor: terms of second order.",
      nonlinear_30_ms);
  add("chatter-small-amplitude", "verification",
      stands + "Whole bite and linear bite, condition 2 at 18.2 m/s, both work rolls moved by 10 nm, 0.3 s; "
               "relative distance of the records in three linearisations and on three stands.",
      "exact linear motion", "1e-3: amplitude over draft is 1e-4, and the integrator adds 1e-8 per step.",
      small_amplitude);
  add("chatter-record-growth", "verification",
      stands + "Stand D, condition 2: growth and frequency fitted to 0.6 s of the gap under the whole bite, "
               "at 18.0, 18.2 and 18.4 m/s; both work rolls moved by 0.1 um.",
      "eigenvalues of the coupled matrix",
      "1 % of the growth rate, 1e-5 of the frequency: what the amplitude of 0.1 um adds to a growth of a few "
      "percent per second.",
      record_growth);
  add("chatter-whole-second", "verification",
      stands + "One second of nonlinear motion, small and in limit cycles with slack strip, skidding and parting "
               "rolls.",
      "the time asked for", "1e-12 s: a run that stops early says why instead.", whole_second);
  for (Case &c : chatter_event_cases())
    cases.push_back(std::move(c));
  return cases;
}
}  // namespace mill::verify
