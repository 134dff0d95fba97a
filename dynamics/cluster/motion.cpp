#include "dynamics/cluster/motion.h"
#include "core/numerics/eigen_instances.h"
#include "dynamics/cluster/modes.h"
#include "dynamics/cluster/motion_equations.h"
#include "dynamics/cluster/time_steps.h"
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace mill::cluster {
namespace {
// Length from which tolerances are counted: what the start or the drive moves in a period of the highest mode.
double length_of(const Stack &stack, const Motion &rest, const std::vector<Drive> &drives,
                 const Eigen::VectorXd &start, const Eigen::VectorXd &speed)
{
  const double highest = 2 * M_PI * modes(stack, rest).back().frequency;
  double length        = std::max(start.cwiseAbs().maxCoeff(), speed.cwiseAbs().maxCoeff() / highest);
  for (const Drive &d : drives)
    length = std::max(length, d.force.norm() / (stack.rolls[std::size_t(d.roll)].mass * highest * highest));
  return length > 0 ? length : 1e-12;
}

class Recorder {
public:
  Recorder(const MotionEquations &e, const Eigen::Index rows) : equations_(e)
  {
    const int n = e.unknowns();
    h.time.resize(rows);
    h.displacement.resize(n, rows);
    h.velocity.resize(n, rows);
    h.contact_force.resize(e.contacts(), rows);
    h.energy.resize(rows);
    h.energy_balance.resize(rows);
  }

  void record(const Eigen::Index row, const double time, const double *state)
  {
    const int n             = equations_.unknowns();
    h.time[row]             = time;
    h.displacement.col(row) = Eigen::Map<const Eigen::VectorXd>(state, n);
    h.velocity.col(row)     = Eigen::Map<const Eigen::VectorXd>(state + n, n);
    equations_.contact_forces(time, state, h.contact_force.col(row).data());
    h.energy[row]         = equations_.energy(state);
    h.energy_balance[row] = h.energy[row] - h.energy[0] - state[2 * n];
    Eigen::Vector2d momentum(0, 0);
    for (int i = 0; i < n; ++i)
      momentum[i % 2] += equations_.mass()[i] * state[n + i];
    if (row == 0)
      first_ = momentum;
    const Eigen::Vector2d impulse(state[2 * n + 1], state[2 * n + 2]);
    h.momentum_balance = std::max(h.momentum_balance, (momentum - first_ - impulse).norm());
    h.largest_momentum = std::max(h.largest_momentum, std::max(momentum.norm(), impulse.norm()));
  }

  MotionHistory h;

private:
  const MotionEquations &equations_;
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();
};

void cut(MotionHistory &h, const Eigen::Index rows)
{
  h.time.conservativeResize(rows);
  h.displacement.conservativeResize(Eigen::NoChange, rows);
  h.velocity.conservativeResize(Eigen::NoChange, rows);
  h.contact_force.conservativeResize(Eigen::NoChange, rows);
  h.energy.conservativeResize(rows);
  h.energy_balance.conservativeResize(rows);
}
}  // namespace

MotionHistory move(const Stack &stack, const Motion &rest, const std::vector<Drive> &drives,
                   const MotionOptions &options, const Eigen::VectorXd &start, const Eigen::VectorXd &speed)
{
  Stack flat   = stack;
  flat.coupled = false;
  MotionEquations equations(flat, rest, drives);
  const int n           = equations.unknowns();
  Eigen::VectorXd state = Eigen::VectorXd::Zero(equations.size());
  if (start.size() == n)
    state.head(n) = start;
  if (speed.size() == n)
    state.segment(n, n) = speed;
  const double length = length_of(flat, rest, drives, state.head(n), state.segment(n, n));
  TimeSteps steps(equations, flat, rest, state, options.tolerance, length);
  const auto rows = Eigen::Index(std::floor(options.duration / options.interval + 1e-9)) + 1;
  Recorder recorder(equations, rows);
  recorder.record(0, 0, steps.state());
  Eigen::Index row = 1;
  for (; row < rows && !recorder.h.stopped_by_events; ++row) {
    const double target = double(row) * options.interval;
    while (steps.time() < target && !recorder.h.stopped_by_events) {
      for (const auto &crossing : steps.advance(target))
        recorder.h.events.push_back({steps.time(), crossing.contact, crossing.opens});
      recorder.h.stopped_by_events = int(recorder.h.events.size()) > options.most_events;
    }
    if (recorder.h.stopped_by_events)
      break;
    recorder.record(row, target, steps.state());
  }
  cut(recorder.h, row);
  recorder.h.steps       = steps.steps;
  recorder.h.evaluations = steps.evaluations;
  return std::move(recorder.h);
}

Eigen::VectorXd velocity_amplitudes(const MotionHistory &history, const double frequency, const double share)
{
  const Eigen::Index rows = Eigen::Index(share * double(history.time.size()));
  const Eigen::Index from = history.time.size() - rows;
  Eigen::MatrixXd basis(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double angle = 2 * M_PI * frequency * history.time[from + i];
    basis.row(i) << 1, std::cos(angle), std::sin(angle);
  }
  const Eigen::MatrixXd fitted = (basis.transpose() * basis)
                                     .partialPivLu()
                                     .solve(basis.transpose() * history.velocity.rightCols(rows).transpose());
  return fitted.bottomRows(2).colwise().norm().transpose();
}

void add_viscous_damping(Stack &stack, const Motion &rest, const double frequency, const double depth_share)
{
  for (Contact &c : stack.contacts) {
    const double d = contact_state(stack, c, rest).approach;
    if (d <= 0)
      continue;
    const double viscous = c.loss_factor * contact_tangent(c, d) / (2 * M_PI * frequency);
    if (viscous <= c.damping)
      continue;
    c.damping = viscous;
    c.depth   = depth_share * d;
  }
}
}  // namespace mill::cluster
