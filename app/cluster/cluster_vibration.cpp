#include "app/cluster/cluster_results.h"
#include "app/run/curve_files.h"
#include "core/base/files.h"
#include "core/base/short_number.h"
#include "core/records/cluster_names.h"
#include "core/records/rows_of_cluster.h"
#include "dynamics/cluster/backbone.h"
#include "dynamics/cluster/response.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
const char *const directions[] = {"x", "y"};

std::string motion_name(const ClusterStand &stand, const Eigen::Index unknown, const int per_roll)
{
  return stand.rolls[std::size_t(unknown / per_roll)].name + " " + directions[unknown % per_roll];
}

// Even over the range, and around every mode where the response is steep.
Eigen::VectorXd response_frequencies(const ClusterStand &stand, const ClusterPassRun &pass)
{
  auto range = stand.response.frequencies;
  if (std::isnan(range[0]))
    range = {50, 1.2 * pass.state.modes.back().frequency};
  std::vector<double> all;
  for (int i = 0; i < stand.response.points; ++i)
    all.push_back(range[0] + (range[1] - range[0]) * i / (stand.response.points - 1));
  for (const cluster::Mode &mode : pass.state.modes)
    for (const double offset : {-0.03, -0.01, -0.003, -0.001, 0., 0.001, 0.003, 0.01, 0.03})
      if (const double f = mode.frequency * (1 + offset); f > range[0] && f < range[1])
        all.push_back(f);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

void write_response(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass)
{
  const Eigen::VectorXd frequencies = response_frequencies(stand, pass);
  const Eigen::MatrixXcd u          = cluster::harmonic_responses(
               pass.state.stack, pass.state.rest.u,
               cluster_dynamic_load(pass.state.stack, pass.force.value, pass.pass->dynamic_force), frequencies);
  Table t;
  t.add("frequency", "Hz", frequencies);
  const int per_roll = pass.state.stack.per_roll();
  for (Eigen::Index k = 0; k < u.rows(); ++k)
    if (k % per_roll < 2)
      t.add(motion_name(stand, k, per_roll), "m/s",
            2 * M_PI * frequencies.cwiseProduct(u.row(k).cwiseAbs().transpose()));
  write_curve(run, curve::cluster_response, slug(pass.pass->name), t);
}

// Velocity and acceleration at the frequency of the dynamic force: of the linear response, and of the history.
// @param nonlinear  m/s, x and y of every roll; empty: without a history
void add_velocities(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                    const Eigen::VectorXcd &linear, const Eigen::VectorXd &nonlinear, ClusterHistoryRecord &record)
{
  const double omega = 2 * M_PI * record.frequency;
  const int per_roll = pass.state.stack.per_roll();
  for (Eigen::Index i = 0; i < Eigen::Index(stand.rolls.size()); ++i)
    for (int k = 0; k < 2; ++k) {
      const std::string name = stand.rolls[std::size_t(i)].name;
      const double steady    = omega * std::abs(linear[per_roll * i + k]);
      record.linear.push_back({name + " " + directions[k], steady});
      if (nonlinear.size() > 0)
        record.nonlinear.push_back({name + " " + directions[k], nonlinear[2 * i + k]});
      const auto add = [&](const RowOf<3> &row, const double factor, const char *method) {
        Parameter p;
        p.value       = factor * steady;
        p.unit        = row.unit;
        p.method      = method;
        p.at          = {"{}, {} at {}",
                         {{pass.force.value, "kN", ".5g"}, {record.force, "N", ".4g"}, {record.frequency, "Hz", ".5g"}}};
        p.inputs      = pass.driven_keys;
        p.error_lacks = {"response.loss_factor"};
        if (nonlinear.size() > 0)
          p.checks.push_back({"history with one-sided contacts and viscous damping (38.20), over its second half",
                              factor * nonlinear[2 * i + k],
                              "the history has viscous damping and a remainder of its start"});
        run.results.add(row.of(pass.pass->name, name, directions[k]), p);
      };
      add(row::cluster::velocity, 1, "harmonic response with complex stiffness (38.16)");
      add(row::cluster::acceleration, omega,
          "harmonic response with complex stiffness (38.16), angular frequency times velocity");
    }
}

void find_least_force(const ClusterPassRun &pass, const cluster::MotionHistory &h, ClusterHistoryRecord &record)
{
  for (std::size_t c = 0; c < pass.state.stack.contacts.size(); ++c) {
    const double rest = pass.state.rest.contact_loads[c];
    if (!(pass.state.stack.contacts[c].one_sided || pass.state.stack.contacts[c].strip) || rest <= 0)
      continue;
    const double least = h.contact_force.row(Eigen::Index(c)).minCoeff() / rest;
    if (std::isnan(record.least_force) || least < record.least_force) {
      record.least_force   = least;
      record.least_contact = pass.state.stack.contacts[c].name;
    }
  }
  record.events = int(h.events.size());
  for (const cluster::ContactEvent &e : h.events)
    if (e.opens) {
      record.first_opening = e.time;
      break;
    }
}

std::string verdict_of(const ClusterHistoryRecord &r)
{
  if (r.events > 0)
    return fmt::format("contacts open ({} events, first after {:.4g} ms): linearising is not enough at this force",
                       r.events, 1e3 * r.first_opening);
  if (std::abs(r.difference) > 0.05)
    return fmt::format(
        "no contact opens, the velocity of the roll at the strip differs by {:.2g} % from the linear one: "
        "the transient of the start has not decayed, or the stiffness changes with the force",
        100 * r.difference);
  return fmt::format(
      "linearising is enough: no contact opens, the velocity of the roll at the strip differs by {:.2g} %",
      100 * r.difference);
}

void write_history(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                   const cluster::MotionHistory &h)
{
  Table t;
  t.add("time", "s", h.time);
  for (std::size_t c = 0; c < pass.state.stack.contacts.size(); ++c)
    t.add(pass.state.stack.contacts[c].name, "N", h.contact_force.row(Eigen::Index(c)).transpose());
  for (Eigen::Index k = 0; k < h.velocity.rows(); ++k)
    t.add(motion_name(stand, k, 2), "m/s", h.velocity.row(k).transpose());
  write_curve(run, curve::cluster_history, slug(pass.pass->name), t);
}

// Frequency over amplitude of the modes that carry the strip roll up and down.
void write_backbones(RunContext &run, const ClusterPassRun &pass)
{
  if (pass.state.stack.coupled)
    return;
  double least = 0;  // smallest approach of a contact under load; that of the strip is from its state at rest
  for (const cluster::Contact &c : pass.state.stack.contacts)
    if (const double d = cluster::contact_state(pass.state.stack, c, pass.state.rest.u).approach;
        !c.strip && d > 0 && (least == 0 || d < least))
      least = d;
  if (least == 0)
    return;
  std::vector<double> amplitudes;
  for (double a = 0.05 * least; amplitudes.size() < 20; a *= 1.5)
    amplitudes.push_back(a);
  for (std::size_t k = 0; k < pass.state.modes.size(); ++k) {
    const auto points = cluster::backbone(pass.state.stack, pass.state.rest.u, int(k), amplitudes, {5, 32});
    if (points.size() < 3)
      continue;
    Eigen::VectorXd a(Eigen::Index(points.size())), f(a), second(a), open(a);
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      const auto &p = points[std::size_t(i)];
      a[i]          = p.amplitude;
      f[i]          = p.frequency;
      second[i]     = p.second;
      open[i]       = p.least_approach;
    }
    const double bend = f.tail(1)[0] / f[0] - 1;
    if (std::abs(bend) < 1e-3 && pass.state.modes.size() > 4)
      continue;  // straight
    Table t;
    t.add("amplitude", "m", a)
        .add("frequency", "Hz", f)
        .add("second_harmonic", "", second)
        .add("least_approach", "m", open);
    write_curve(run, curve::cluster_backbone, fmt::format("{}-f{}", slug(pass.pass->name), k + 1), t);
  }
}
}  // namespace

Eigen::VectorXd cluster_dynamic_load(const cluster::Stack &stack, const double rolling_force,
                                     const double amplitude)
{
  Eigen::VectorXd f = Eigen::VectorXd::Zero(stack.size());
  for (const cluster::Load &load : stack.loads)
    f.segment<2>(stack.per_roll() * load.roll) += amplitude / rolling_force * load.force;
  return f;
}

void add_vibration(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                   ClusterPassRecord &record)
{
  const bool coupled = pass.state.stack.coupled;
  if (pass.p == 0 && coupled)
    run.warn({WarningId::coupled_stack,
              "",
              "stack.spin = \"coupled\" has no history and no frequency over amplitude",
              "both are solved for rolls that turn freely; the linear response is that of the coupled stack",
              "spin = \"free\" gives all three",
              {},
              "stack.spin"});
  if (pass.p == 0)
    write_backbones(run, pass);
  if (std::isnan(pass.pass->dynamic_force) || std::isnan(pass.pass->dynamic_frequency))
    return;
  write_response(run, stand, pass);
  ClusterHistoryRecord h;
  h.force     = stand.response.force_factor * pass.pass->dynamic_force;
  h.frequency = pass.pass->dynamic_frequency;
  const auto linear =
      cluster::harmonic_response(pass.state.stack, pass.state.rest.u,
                                 cluster_dynamic_load(pass.state.stack, pass.force.value, h.force), h.frequency);
  if (coupled) {
    add_velocities(run, stand, pass, linear, {}, h);
    return;
  }
  cluster::Stack moving = pass.state.stack;
  cluster::add_viscous_damping(moving, pass.state.rest.u, h.frequency, stand.response.depth_share);
  std::vector<cluster::Drive> drives;
  for (const cluster::Load &load : moving.loads)
    drives.push_back({load.roll, h.force / pass.force.value * load.force, h.frequency});
  // Between two rolls the dynamic force is a part of what the strip carries: it ends where the strip lets go.
  for (std::size_t c = 0; c < moving.contacts.size(); ++c)
    if (moving.contacts[c].strip)
      drives = {{moving.contacts[c].b, Eigen::Vector2d(0, h.force), h.frequency, int(c)}};
  cluster::MotionOptions options;
  options.duration   = stand.response.duration;
  options.interval   = std::min(0.05 / h.frequency, stand.response.duration / 200);
  const auto history = cluster::move(moving, pass.state.rest.u, drives, options);
  const auto moved   = cluster::velocity_amplitudes(history, h.frequency);
  add_velocities(run, stand, pass, linear, moved, h);
  const int roll = cluster::strip_roll(stand);
  h.difference   = h.nonlinear[std::size_t(2 * roll + 1)].value / h.linear[std::size_t(2 * roll + 1)].value - 1;
  find_least_force(pass, history, h);
  if (history.stopped_by_events)
    run.warn({WarningId::history_stopped, "pass \"" + pass.pass->name + "\"",
              fmt::format("the history stopped after {:.4g} ms, contacts open and close too often",
                          1e3 * history.time.tail(1)[0])});
  h.verdict = verdict_of(h);
  write_history(run, stand, pass, history);
  record.histories.push_back(h);
  run.progress.note(fmt::format("pass \"{}\": {}", pass.pass->name, h.verdict));
}
}  // namespace mill
