#include "core/model/case.h"
#include "dynamics/chatter/run.h"
#include "dynamics/response/matrix_exponential.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// Chatter of large amplitude: slack strip, lost contacts, limit cycles.
namespace mill::verify {
std::vector<Case> chatter_event_cases();

namespace {
using namespace dynamics;
using Eigen::Index;
using Eigen::VectorXd;
using mill::Linearisation;

struct Set {
  ChatterStandModel stand = chatter_stand("D");
  WorkingPoint point;
  ChatterRunOptions options;

  explicit Set(const double speed, const double duration)
      : point(working_point(film_bite(2, speed), speed, Linearisation::sequential))
  {
    options.duration = duration;
    options.contacts = roll_contacts(stand.structure, point.state.force);
  }
  ChatterRun run(const VectorXd &start) const
  {
    return nonlinear_run(stand, point, Linearisation::sequential, start, options);
  }
};

Check exactly(const std::string &quantity, const double result, const double reference)
{
  return {quantity, "-", result, reference, 0, Judged::absolute};
}

Index count(const ChatterRun &run, const ChatterChange change, const double from = 0)
{
  return std::count_if(run.events.begin(), run.events.end(),
                       [&](const ChatterEvent &e) { return e.change == change && e.time >= from; });
}

// A strip that no roll touches: the stand swings under a constant force, the two spans exchange momentum; both
// linear, so that one exponential of the motion extended by a constant is exact.
std::vector<Check> free_strip()
{
  Set set(18.2, 1e-3);
  const StandStructure &s       = set.stand.structure;
  const bite::BiteState &steady = set.point.state;
  const auto &strip             = set.point.bite.strip;
  set.options.rate              = 1e6;
  set.options.tolerance         = 1e-10;
  const VectorXd start          = displaced_rolls(s, 2e-4);
  const ChatterRun run          = set.run(start);
  const auto gripped            = std::find_if(run.events.begin(), run.events.end(), [](const ChatterEvent &e) {
    return e.change == ChatterChange::strip_gripped;
  });

  Eigen::MatrixXd A          = Eigen::MatrixXd::Zero(15, 15);
  const Eigen::MatrixXd over = s.M.inverse();
  A.block(0, 6, 6, 6)        = Eigen::MatrixXd::Identity(6, 6);
  A.block(6, 0, 6, 6)        = -over * s.K;
  A.block(6, 6, 6, 6)        = -over * s.C;
  A.block(6, 14, 6, 1)       = -steady.force * over * s.b;
  const double per_length    = set.stand.strip_modulus / set.stand.entry_distance,
               impedance     = std::sqrt(set.stand.strip_modulus * 7850);
  const double h0 = strip.entry_thickness, h1 = strip.exit_thickness, both = h0 + h1;
  // speed = (h0 v0 + h1 v1 + (h1 sigma1 - h0 sigma0)/impedance)/(h0 + h1)
  const double at_start = (h0 * steady.entry_speed + h1 * steady.exit_speed +
                           (h1 * strip.exit_tension - h0 * strip.entry_tension) / impedance) /
                          both;
  A.block(12, 12, 2, 2) << -h0, h1, h0, -h1;
  A.block(12, 12, 2, 2) *= per_length / (impedance * both);
  A(12, 14)        = per_length * (at_start - steady.entry_speed);
  A(13, 14)        = -per_length * (at_start - steady.exit_speed);
  const auto exact = [&](const double time) -> VectorXd {
    VectorXd z(15);
    z << start, 1;
    VectorXd scale = VectorXd::Constant(15, 1e-4);  // m; brings rows and columns to one size
    scale.segment(6, 6).setConstant(0.1);
    scale.segment(12, 2).setConstant(1e8);
    scale[14] = 1;
    return scale.asDiagonal() *
           (matrix_exponential(scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal() * time) *
            z.cwiseQuotient(scale));
  };
  const double last = std::floor(gripped->time * 1e6) * 1e-6;  // moment of the record before the event
  const auto k      = Index(std::lround(last * 1e6));
  const VectorXd z = exact(last), at_grip = exact(gripped->time);
  std::vector<Check> checks;
  checks.push_back(
      relative("gap when the rolls grip", "mm", 1e3 * (h1 + s.b.dot(at_grip.head(6))), 1e3 * h0, 1e-8));
  checks.push_back(relative("gap change before", "um", 1e6 * run.history.gap[k], 1e6 * s.b.dot(z.head(6)), 1e-8));
  checks.push_back(
      relative("entry tension before", "MPa", 1e-6 * run.history.entry_tension[k], 1e-6 * z[12], 1e-8));
  checks.push_back(relative("exit tension before", "MPa", 1e-6 * run.history.exit_tension[k], 1e-6 * z[13], 1e-8));
  checks.push_back(at_most("force while free", "N", std::abs(run.history.force[k] + steady.force), 1e-6));
  return checks;
}

// Fixed steps of the classical Runge-Kutta method over edges and all, with equations written independently.
VectorXd runge_kutta(const Set &set, VectorXd z, const double duration, const int steps)
{
  const StandStructure &s   = set.stand.structure;
  const auto u              = bite::unsteady_bite(set.point.bite, set.point.state, Linearisation::sequential);
  const bite::Moment steady = bite::steady_moment(u);
  const auto base           = bite::bite_at(u, steady);
  const double per_entry    = set.stand.strip_modulus / set.stand.entry_distance,
               per_exit     = set.stand.strip_modulus / set.stand.exit_distance;
  const auto slope          = [&](const VectorXd &y) {
    const VectorXd x = y.head(6), v = y.segment(6, 6);
    const auto a   = bite::bite_at(u, {steady[0] + x[2] + x[3], v[2] + v[3], std::max(0., steady[2] + y[12]),
                                       std::max(0., steady[3] + y[13]), steady[4]});
    VectorXd force = -s.K * x - s.C * v;
    for (const int roll : {2, 3})
      force[roll] += a.force - base.force;
    VectorXd d(14);
    d << v, force.cwiseQuotient(s.M.diagonal()), per_entry * (a.entry_speed - base.entry_speed),
        -per_exit * (a.exit_speed - base.exit_speed);
    return d;
  };
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const VectorXd k1 = slope(z), k2 = slope(z + 0.5 * h * k1), k3 = slope(z + 0.5 * h * k2),
                   k4 = slope(z + h * k3);
    z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return z;
}

std::vector<Check> against_runge_kutta()
{
  std::vector<Check> checks;
  const auto compare = [&](const std::string &name, const double gap, const int steps, const double tolerance,
                           const double events) {
    Set set(19, 0.03);
    set.options.tolerance = 1e-10;
    const VectorXd start  = critical_mode(set.stand, set.point.by, gap);
    const ChatterRun run  = set.run(start);
    const VectorXd other  = runge_kutta(set, start, 0.03, steps);
    checks.push_back(exactly(name + "slack strip, times", double(count(run, ChatterChange::entry_slack)), events));
    checks.push_back(exactly(name + "skidding, times", double(count(run, ChatterChange::skid_exit)), events));
    checks.push_back(at_most(name + "displacements apart", "-",
                             (run.history.last - other).head(6).norm() / other.head(6).norm(), tolerance));
    checks.push_back(at_most(name + "tensions apart", "-",
                             (run.history.last - other).tail(2).norm() / other.tail(2).norm(), tolerance));
  };
  compare("50 um, smooth: ", 50e-6, 6000, 1e-8, 0);
  compare("186 um, with edges: ", 186e-6, 15000, 1e-6, 4);  // 3.9 swings
  return checks;
}

std::vector<Check> run_restart()
{
  Set set(21, 0.1);
  const VectorXd start = critical_mode(set.stand, set.point.by, 190e-6);
  const ChatterRun run = set.run(start);
  const auto apart     = [&](const ChatterRun &other) {
    return (run.history.last - other.history.last).head(6).norm() / run.history.last.head(6).norm();
  };
  Set finer               = set;
  finer.options.tolerance = 1e-9;
  Set half                = set;
  half.options.duration   = 0.05;
  const ChatterRun fine = finer.run(start), second = half.run(half.run(start).history.last);
  std::vector<Check> checks;
  checks.push_back(
      exactly("events at a tenth of the tolerance", double(fine.events.size()), double(run.events.size())));
  checks.push_back(at_most("last state at a tenth of the tolerance", "-", apart(fine), 2e-6));
  checks.push_back(at_most("last state in two halves", "-", apart(second), 2e-6));
  return checks;
}

std::vector<Check> limit_cycles()
{
  const Set set(19, 0.8);
  const auto from      = [&](const double gap) { return set.run(critical_mode(set.stand, set.point.by, gap)); };
  const ChatterRun low = from(120e-6), high = from(250e-6);
  const LimitCycle below = limit_cycle(low), above = limit_cycle(high);
  const double second = 0.4;  // events of this last part count
  const auto times    = [&](const ChatterChange change) {
    return double(count(low, change, second)) / ((0.8 - second) * below.frequency);
  };
  std::vector<Check> checks;
  checks.push_back(relative("amplitude from below against from above", "um", 1e6 * below.amplitude,
                            1e6 * above.amplitude, 2e-3));
  checks.push_back(
      relative("frequency from below against from above", "Hz", below.frequency, above.frequency, 1e-4));
  checks.push_back(at_most("drift from below", "1/s", std::abs(below.drift), 0.01));
  checks.push_back(at_most("drift from above", "1/s", std::abs(above.drift), 0.01));
  checks.push_back(
      relative("entry strip slack, times per swing", "-", times(ChatterChange::entry_slack), 1, 0.02));
  checks.push_back(relative("skidding, times per swing", "-", times(ChatterChange::skid_exit), 1, 0.02));
  return checks;
}
}  // namespace

std::vector<Case> chatter_event_cases()
{
  const std::string stands = chatter_stands;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const std::string &problem, const std::string &source, const char *reason,
                       std::vector<Check> (*run)()) {
    cases.push_back({name, "verification", stands + problem, source, reason, run});
  };
  add("chatter-free-strip",
      "Stand D, condition 2: the work rolls start 0.2 mm away each, so that no roll touches the strip until the "
      "gap has closed to the entry thickness.",
      "matrix exponential of the free stand under a constant force and of the strip's two spans",
      "1e-8: exact, against an integrator of 1e-10 per step.", free_strip);
  add("chatter-runge-kutta",
      "Stand D, condition 2 at 19 m/s, whole bite: CVODE with events against fixed Runge-Kutta steps and "
      "equations "
      "written a second time, 30 ms, without and with slack strip and skidding.",
      "classical Runge-Kutta method",
      "1e-8: steps of 5 us at 435 Hz; 1e-6: a step of 2 us over a kink errs by its square.", against_runge_kutta);
  add("chatter-run-restart",
      "Stand D, condition 2 at 21 m/s, 0.1 s of chatter with slack strip, skidding, lost strip and parting rolls: "
      "a "
      "tenth of the tolerance, and the same run in two halves.",
      "the run itself", "2e-6: 1e-8 per step over a few thousand steps between events that attract.", run_restart);
  add("chatter-limit-cycle",
      "Stand D, condition 2 at 19 m/s, above the critical speed: 0.8 s from a gap amplitude of 0.12 and of 0.25 "
      "mm. What limits the motion: the entry strip goes slack and the rolls skid once in every swing.",
      "the two runs against each other",
      "2e-3: the mode of 81 Hz, which dies at 0.5 1/s, is still in the record; one event per swing up to the "
      "ends of the window.",
      limit_cycles);
  return cases;
}
}  // namespace mill::verify
