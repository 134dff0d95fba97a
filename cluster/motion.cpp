#include "cluster/motion.h"
#include "cluster/modes.h"
#include "cluster/motion_equations.h"
#include "core/case/errors.h"
#include "core/numerics/eigen_instances.h"
#include <Eigen/QR>
#include <algorithm>
#include <arkode/arkode_erkstep.h>
#include <cmath>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>

namespace mill::cluster {
namespace {
// ARKODE with one set of equations.
class Integrator {
public:
  Integrator(MotionEquations &e, const Eigen::VectorXd &start) : equations_(e)
  {
    require(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
    state_     = N_VNew_Serial(start.size(), context_);
    tolerance_ = N_VNew_Serial(start.size(), context_);
    std::copy(start.data(), start.data() + start.size(), data());
    memory_ = ERKStepCreate(slope, 0, state_, context_);
    if (!memory_)
      require(-1, "ERKStepCreate");
    require(ERKStepSetErrHandlerFn(memory_, listen, this), "ERKStepSetErrHandlerFn");
    require(ERKStepSetUserData(memory_, this), "ERKStepSetUserData");
    require(ERKStepSetTableNum(memory_, ARKODE_VERNER_8_5_6), "ERKStepSetTableNum");
    require(ERKStepSetMaxNumSteps(memory_, 1000000), "ERKStepSetMaxNumSteps");
    require(ERKStepRootInit(memory_, equations_.contacts(), edges), "ERKStepRootInit");
    require(ERKStepSetNoInactiveRootWarn(memory_), "ERKStepSetNoInactiveRootWarn");
  }
  Integrator(const Integrator &)            = delete;
  Integrator &operator=(const Integrator &) = delete;
  ~Integrator()
  {
    ERKStepFree(&memory_);
    if (state_)
      N_VDestroy(state_);
    if (tolerance_)
      N_VDestroy(tolerance_);
    SUNContext_Free(&context_);
  }

  double *data()
  {
    return N_VGetArrayPointer(state_);
  }

  // Tolerances of displacements, velocities and the three sums; the longest step.
  void accuracy(const double relative, const double length, const double speed, const double longest)
  {
    const int n = equations_.unknowns();
    double *t   = N_VGetArrayPointer(tolerance_);
    std::fill(t, t + n, relative * length);
    std::fill(t + n, t + 2 * n, relative * speed);
    std::fill(t + 2 * n, t + 2 * n + 3, 1e20);  // the sums follow, they do not choose the step
    require(ERKStepSVtolerances(memory_, relative, tolerance_), "ERKStepSVtolerances");
    require(ERKStepSetMaxStep(memory_, longest), "ERKStepSetMaxStep");
  }

  // To `time`, or to the contact that opens or closes before it: true.
  bool advance(const double time, double &reached)
  {
    const int flag = ERKStepEvolve(memory_, time, state_, &reached, ARK_NORMAL);
    require(flag, "ERKStepEvolve");
    return flag == ARK_ROOT_RETURN;
  }
  std::vector<int> crossed()
  {
    std::vector<int> which(std::size_t(equations_.contacts()));
    require(ERKStepGetRootInfo(memory_, which.data()), "ERKStepGetRootInfo");
    return which;
  }
  void count(long &steps, long &evaluations)
  {
    ERKStepGetNumSteps(memory_, &steps);
    ERKStepGetNumRhsEvals(memory_, &evaluations);
  }
  void stop_at(const double time)
  {
    require(ERKStepSetStopTime(memory_, time), "ERKStepSetStopTime");
  }

private:
  static int slope(const double t, N_Vector y, N_Vector dy, void *self)
  {
    static_cast<Integrator *>(self)->equations_.slope(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
  }
  static int edges(double, N_Vector y, double *value, void *self)
  {
    static_cast<Integrator *>(self)->equations_.approaches(N_VGetArrayPointer(y), value);
    return 0;
  }
  static void listen(int, const char *, const char *, char *message, void *self)
  {
    static_cast<Integrator *>(self)->complaint_ = message;
  }
  void require(const int flag, const char *what) const
  {
    if (flag < 0)
      throw SolverError({fmt::format("stack in time: {} failed with flag {}", what, flag), complaint_,
                         "the motion grows without bound, or contacts rattle too fast",
                         "a smaller dynamic force, more damping, a shorter run", ""});
  }

  MotionEquations &equations_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr, tolerance_ = nullptr;
  void *memory_ = nullptr;
  std::string complaint_;
};

// Length and speed from which tolerances are counted: what the drive makes at rest stiffness, or the start.
struct Scales {
  double length = 0, speed = 0, longest_step = 0;
};
Scales scales_of(const Stack &stack, const Motion &rest, const std::vector<Drive> &drives,
                 const Eigen::VectorXd &start, const Eigen::VectorXd &speed)
{
  const std::vector<Mode> all = modes(stack, rest);
  const double highest        = 2 * M_PI * all.back().frequency;
  Scales s;
  s.length = start.cwiseAbs().maxCoeff();
  s.speed  = speed.cwiseAbs().maxCoeff();
  for (const Drive &d : drives) {
    const double m = stack.rolls[std::size_t(d.roll)].mass;
    s.speed        = std::max(s.speed, d.force.norm() / (m * highest));
  }
  s.speed  = std::max(s.speed, s.length * highest * 1e-3);
  s.length = std::max(s.length, s.speed / highest);
  if (s.length == 0) {
    s.length = 1e-12;
    s.speed  = s.length * highest;
  }
  s.longest_step = 0.5 * M_PI / highest;  // a quarter of the shortest period: no contact opens and closes inside it
  return s;
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
    const int n        = equations_.unknowns();
    h.time[row]        = time;
    h.displacement.col(row) = Eigen::Map<const Eigen::VectorXd>(state, n);
    h.velocity.col(row)     = Eigen::Map<const Eigen::VectorXd>(state + n, n);
    equations_.contact_forces(state, h.contact_force.col(row).data());
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
  const int n             = equations.unknowns();
  Eigen::VectorXd state   = Eigen::VectorXd::Zero(equations.size());
  if (start.size() == n)
    state.head(n) = start;
  if (speed.size() == n)
    state.segment(n, n) = speed;
  const Scales scales = scales_of(flat, rest, drives, state.head(n), state.segment(n, n));
  Integrator integrator(equations, state);
  integrator.accuracy(options.tolerance, scales.length, scales.speed, scales.longest_step);
  const auto rows = Eigen::Index(std::floor(options.duration / options.interval + 1e-9)) + 1;
  Recorder recorder(equations, rows);
  recorder.record(0, 0, state.data());
  Eigen::Index row = 1;
  for (double reached = 0; row < rows && !recorder.h.stopped_by_events; ++row) {
    const double target = double(row) * options.interval;
    integrator.stop_at(target);
    while (integrator.advance(target, reached)) {
      const std::vector<int> which = integrator.crossed();
      for (std::size_t c = 0; c < which.size(); ++c)
        if (which[c] != 0 && flat.contacts[c].one_sided)
          recorder.h.events.push_back({reached, int(c), which[c] < 0});
      recorder.h.stopped_by_events = int(recorder.h.events.size()) > options.most_events;
      if (recorder.h.stopped_by_events)
        break;
    }
    if (recorder.h.stopped_by_events)
      break;
    recorder.record(row, reached, integrator.data());
  }
  cut(recorder.h, row);
  integrator.count(recorder.h.steps, recorder.h.evaluations);
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
    c.damping = c.loss_factor * tangent(c.law, d) / (2 * M_PI * frequency);
    c.depth   = depth_share * d;
  }
}
}  // namespace mill::cluster
