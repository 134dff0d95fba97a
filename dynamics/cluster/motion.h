#pragma once
#include "dynamics/cluster/stack.h"
#include <functional>
#include <memory>
#include <string>

// The stack in time: one-sided contacts with impact damping, separation.  theory.md 38.6
namespace mill::cluster {
/// A harmonic force on one roll, P sin(omega t), or a harmonic part of what the strip carries.
struct Drive {
  int roll              = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< N, amplitude
  double frequency      = 0;                        ///< Hz
  int strip             = -1;  ///< index of the strip in the contacts: both its rolls are driven, by the length of
                               ///< `force`, as long as its whole force is above zero; -1: one roll
};

/// A contact that opens or closes.
struct ContactEvent {
  double time = 0;  ///< s
  int contact = 0;  ///< index in the stack
  bool opens  = false;
};

struct MotionOptions {
  double duration  = 0.01;   ///< s
  double interval  = 1e-5;   ///< s, between the rows of the history
  double tolerance = 1e-8;   ///< -, of the largest displacement and velocity so far, per step
  int most_events  = 10000;  ///< contacts that rattle: the run stops there
};

/// What a run was, per row of `time`.
struct MotionHistory {
  Eigen::VectorXd time;            ///< s
  Eigen::MatrixXd displacement;    ///< m, from the state at rest, unknowns x rows
  Eigen::MatrixXd velocity;        ///< m/s
  Eigen::MatrixXd contact_force;   ///< N, contacts x rows
  Eigen::VectorXd energy;          ///< J, kinetic and potential, zero at rest
  Eigen::VectorXd energy_balance;  ///< J, energy less start less work of drive and damping
  double momentum_balance = 0;     ///< N s, largest |change of momentum less impulse of all outer forces|
  double largest_momentum = 0;     ///< N s
  std::vector<ContactEvent> events;
  long steps = 0, evaluations = 0;
  bool stopped_by_events = false;
};

/// Integrates from a displacement and velocity relative to the state at rest, by collocation of order 12
/// with error control; contacts that open or close end a step.
/// @param stack  anchors set; damping and depth of its contacts as they are; never coupled
/// @param rest   state at rest
/// @param start, speed  m and m/s; empty: at rest
/// @throws SolverError  the integrator gives up
/// Cost: some 130 evaluations of all contacts per period of the highest mode.
MotionHistory move(const Stack &stack, const Motion &rest, const std::vector<Drive> &drives,
                   const MotionOptions &options, const Eigen::VectorXd &start = {},
                   const Eigen::VectorXd &speed = {});

/// Amplitude of every unknown's velocity at a frequency, least squares with a mean over the last `share` of the
/// history, m/s.
Eigen::VectorXd velocity_amplitudes(const MotionHistory &history, double frequency, double share = 0.5);

/// The viscous damping of each contact that equals its loss factor at one frequency, in full at `depth_share` of
/// the approach at rest.  theory.md (38.22)
void add_viscous_damping(Stack &stack, const Motion &rest, double frequency, double depth_share);
}  // namespace mill::cluster
