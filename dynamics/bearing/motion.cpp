#include "dynamics/bearing/motion.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <limits>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace mill::dynamics {
namespace {
using Eigen::Matrix2d;
using Eigen::Vector2d;

double recorded_force(const ForceRecord &record, const double time)
{
  const Eigen::Index n = record.time.size();
  if (n == 0)
    return 0;
  const double *first = record.time.data();
  const auto above    = std::clamp<Eigen::Index>(std::upper_bound(first, first + n, time) - first, 1, n - 1);
  const double share  = (time - record.time[above - 1]) / (record.time[above] - record.time[above - 1]);
  return record.force[above - 1] + share * (record.force[above] - record.force[above - 1]);
}

// Force of the bearing on the mass is minus this; its derivative with the place is the slope along the radius and
// the secant across it.
Vector2d bearing_force(const BearingLaw &law, const Vector2d &position)
{
  const double distance = position.norm();
  return distance > 0 ? Vector2d(force_at(law, distance).force / distance * position) : Vector2d::Zero();
}

Matrix2d bearing_stiffness(const BearingLaw &law, const Vector2d &position)
{
  const double distance = position.norm();
  const auto force      = force_at(law, distance);
  if (force.force == 0)
    return Matrix2d::Zero();
  const Vector2d radial = position / distance;
  const Matrix2d along  = radial * radial.transpose();
  return force.tangent * along + force.force / distance * (Matrix2d::Identity() - along);
}
}  // namespace

BearingMotion bearing_motion(const BearingOscillator &o)
{
  BearingMotion motion;
  motion.mass      = o.mass;
  motion.damping   = o.damping;
  motion.law       = bearing_law(o.curve);
  motion.mean_load = o.mean_load;
  motion.direction = o.direction.norm() > 0 ? Vector2d(o.direction.normalized()) : Vector2d::UnitX();
  motion.amplitude = o.amplitude;
  motion.frequency = o.frequency;
  motion.tolerance = o.tolerance;
  if (o.record) {
    motion.record = *o.record;
    motion.begin  = o.record->time[0];
  }
  return motion;
}

Vector2d applied_force(const BearingMotion &motion, const double time)
{
  double varying = recorded_force(motion.record, time);
  if (motion.amplitude != 0)
    varying += motion.amplitude * std::sin(2 * M_PI * motion.frequency * time);
  return motion.mean_load + varying * motion.direction;
}

Vector2d acceleration(const BearingMotion &motion, const double time, const BearingState &state)
{
  return (applied_force(motion, time) - motion.damping * state.velocity -
          bearing_force(motion.law, state.position)) /
         motion.mass;
}

BearingState at_rest(const BearingMotion &motion)
{
  const Vector2d load = applied_force(motion, motion.begin);
  if (load.norm() == 0)
    return {};
  return {displacement_under(motion.law, load.norm()) * load.normalized(), Vector2d::Zero()};
}

bool touches(const BearingMotion &motion, const BearingState &state)
{
  const double distance = state.position.norm();
  return motion.law.clearance == 0 || distance > motion.law.clearance ||
         (distance == motion.law.clearance && state.position.dot(state.velocity) > 0);
}

struct MotionIntegrator::Solver {
  const BearingMotion &motion;
  SUNContext context     = nullptr;
  N_Vector state         = nullptr;  // x, y, x', y'
  SUNMatrix matrix       = nullptr;
  SUNLinearSolver linear = nullptr;
  void *cvode            = nullptr;
  Eigen::Index next      = 0;  // break of the record that no step may cross
  long earlier_steps     = 0;
  std::string complaint;  // last message of CVODE

  explicit Solver(const BearingMotion &m) : motion(m) {}
  Solver(const Solver &)            = delete;
  Solver &operator=(const Solver &) = delete;
  ~Solver()
  {
    CVodeFree(&cvode);
    if (linear)
      SUNLinSolFree(linear);
    if (matrix)
      SUNMatDestroy(matrix);
    if (state)
      N_VDestroy(state);
    SUNContext_Free(&context);
  }

  static BearingState read(const N_Vector y)
  {
    const double *s = N_VGetArrayPointer(y);
    return {{s[0], s[1]}, {s[2], s[3]}};
  }

  static int slope(const double t, N_Vector y, N_Vector derivative, void *self)
  {
    const BearingState s = read(y);
    const Vector2d a     = acceleration(static_cast<Solver *>(self)->motion, t, s);
    double *d            = N_VGetArrayPointer(derivative);
    d[0]                 = s.velocity[0];
    d[1]                 = s.velocity[1];
    d[2]                 = a[0];
    d[3]                 = a[1];
    return std::isfinite(a[0]) && std::isfinite(a[1]) ? 0 : 1;
  }

  static int jacobian(double, N_Vector y, N_Vector, SUNMatrix j, void *self, N_Vector, N_Vector, N_Vector)
  {
    const BearingMotion &m   = static_cast<Solver *>(self)->motion;
    const Matrix2d stiffness = bearing_stiffness(m.law, read(y).position);
    for (int row = 0; row < 2; ++row) {
      SM_ELEMENT_D(j, row, row + 2)     = 1;
      SM_ELEMENT_D(j, row + 2, row + 2) = -m.damping / m.mass;
      for (int column = 0; column < 2; ++column)
        SM_ELEMENT_D(j, row + 2, column) = -stiffness(row, column) / m.mass;
    }
    return 0;
  }

  // Negative while nothing touches.
  static int depth(double, N_Vector y, double *out, void *self)
  {
    out[0] = read(y).position.norm() - static_cast<Solver *>(self)->motion.law.clearance;
    return 0;
  }

  static void listen(int, const char *, const char *, char *message, void *self)
  {
    static_cast<Solver *>(self)->complaint = message;
  }

  void require(const int flag, const char *what) const
  {
    if (flag < 0)
      throw SolverError({fmt::format("bearing dynamics: {} failed with flag {}", what, flag), complaint,
                         "memory is exhausted", "shorten the record or lower its rate", ""});
  }

  // Size of the motion: how far the bearing deflects under the forces that act, its clearance, and where it
  // starts.
  double length_scale(const BearingState &start) const
  {
    double load = motion.mean_load.norm() + std::abs(motion.amplitude);
    if (motion.record.force.size() > 0)
      load += motion.record.force.cwiseAbs().maxCoeff();
    const double reach = displacement_under(motion.law, load);
    return std::max({reach, start.position.norm(), 1e-3 * motion.law.largest()});
  }

  void start_at(const BearingState &start)
  {
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    state = N_VNew_Serial(4, context);
    for (int i = 0; i < 2; ++i) {
      NV_Ith_S(state, i)     = start.position[i];
      NV_Ith_S(state, i + 2) = start.velocity[i];
    }
    cvode = CVodeCreate(CV_ADAMS, context);
    require(CVodeSetErrHandlerFn(cvode, listen, this), "CVodeSetErrHandlerFn");
    require(CVodeInit(cvode, slope, motion.begin, state), "CVodeInit");
    require(CVodeSetUserData(cvode, this), "CVodeSetUserData");
    matrix = SUNDenseMatrix(4, 4, context);
    linear = SUNLinSol_Dense(state, matrix, context);
    require(CVodeSetLinearSolver(cvode, linear, matrix), "CVodeSetLinearSolver");
    require(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
    set_tolerances(start);
    require(CVodeSetMaxNumSteps(cvode, 1000000), "CVodeSetMaxNumSteps");
    if (motion.law.clearance > 0) {
      require(CVodeRootInit(cvode, 1, depth), "CVodeRootInit");
      require(CVodeSetNoInactiveRootWarn(cvode), "CVodeSetNoInactiveRootWarn");
    }
    set_stop(motion.begin);
  }

  void set_tolerances(const BearingState &start)
  {
    const double size = length_scale(start), reach = std::max(size, motion.law.largest());
    const double fastest = std::sqrt(force_at(motion.law, reach).tangent / motion.mass);  // rad/s
    N_Vector absolute    = N_VClone(state);
    for (int i = 0; i < 2; ++i) {
      NV_Ith_S(absolute, i)     = motion.tolerance * size;
      NV_Ith_S(absolute, i + 2) = motion.tolerance * size * fastest;
    }
    const int flag = CVodeSVtolerances(cvode, motion.tolerance, absolute);
    N_VDestroy(absolute);
    require(flag, "CVodeSVtolerances");
    // A tenth of the shortest period, so that no touch of the rollers and no swing of the force is stepped over.
    double shortest = 2 * M_PI / fastest;
    if (motion.amplitude != 0)
      shortest = std::min(shortest, 1 / motion.frequency);
    require(CVodeSetMaxStep(cvode, 0.1 * shortest), "CVodeSetMaxStep");
  }

  // No step across the next break of the record.
  void set_stop(const double now)
  {
    const Eigen::VectorXd &breaks = motion.record.time;
    while (next < breaks.size() && breaks[next] <= now)
      ++next;
    if (next < breaks.size())
      require(CVodeSetStopTime(cvode, breaks[next]), "CVodeSetStopTime");
  }

  long steps_now() const
  {
    long n = 0;
    CVodeGetNumSteps(cvode, &n);
    return n;
  }

  [[noreturn]] void give_up(const double now, const int flag) const
  {
    const BearingState bearing = read(state);
    throw SolverError(
        {fmt::format("bearing dynamics: the integration stops at t = {:.9g} s (CVODE flag {})", now, flag),
         fmt::format("position {:.6g}, {:.6g} um; {}", 1e6 * bearing.position[0], 1e6 * bearing.position[1],
                     complaint),
         "a damping or a mass many orders from what the stiffness asks for, or a tolerance at rounding",
         "check dynamics.mass and dynamics.damping", "the motion before this time"});
  }
};

MotionIntegrator::MotionIntegrator(const BearingMotion &motion, const BearingState &start)
    : solver_(std::make_unique<Solver>(motion))
{
  solver_->start_at(start);
}

MotionIntegrator::~MotionIntegrator() = default;

BearingState MotionIntegrator::advance(const double time, std::vector<ContactEvent> &events)
{
  Solver &s  = *solver_;
  double now = -std::numeric_limits<double>::infinity();
  while (now < time) {
    const int flag = CVode(s.cvode, time, s.state, &now, CV_NORMAL);
    if (flag < 0)
      s.give_up(now, flag);
    if (flag == CV_TSTOP_RETURN)
      s.set_stop(now);
    if (flag == CV_ROOT_RETURN) {
      int direction = 0;
      s.require(CVodeGetRootInfo(s.cvode, &direction), "CVodeGetRootInfo");
      events.push_back({now, direction > 0});
      s.earlier_steps += s.steps_now();
      s.require(CVodeReInit(s.cvode, now, s.state), "CVodeReInit");
      s.set_stop(now);
    }
  }
  return Solver::read(s.state);
}

long MotionIntegrator::steps() const
{
  return solver_->earlier_steps + solver_->steps_now();
}
}  // namespace mill::dynamics
