#pragma once
#include "core/records/csv.h"
#include "core/records/records.h"
#include "dynamics/bearing/law.h"
#include "dynamics/response/spectrum.h"
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

// One bearing that carries a mass, both radial directions, the contact lost and found again.  theory.md 16
namespace mill::dynamics {
/// Place and speed of the mass, from the concentric position.
struct BearingState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
};

/// m x'' + c x' + F(|x|) x/|x| = P(t), x in two directions.  The force of the bearing points from the mass to the
/// middle and depends on the distance alone, as in a bearing that is the same all round; it never pulls.
struct BearingOscillator {
  double mass    = 0;  ///< kg
  double damping = 0;  ///< N s/m, also while nothing touches
  BearingCurve curve;
  Eigen::Vector2d mean_load = Eigen::Vector2d::Zero();   ///< N
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< -, of what varies; its length has no influence
  double amplitude          = 0;                         ///< N, of amplitude sin(2 pi frequency t)
  double frequency          = 0;                         ///< Hz
  std::optional<ForceRecord>
      record;  ///< on top of it, on straight lines between its samples; gives the first time
  std::optional<BearingState> start;  ///< absent: at rest in the equilibrium under the force of the first instant
  double tolerance = 1e-11;           ///< -, of the integrator, relative to the motion
};

/// The mass leaves the bearing, or comes back.
struct ContactEvent {
  double time;    ///< s
  bool regained;  ///< false: lost
};

/// Motion at n output times.
struct BearingResponse {
  Eigen::VectorXd time;          ///< (n) s
  Eigen::MatrixXd position;      ///< (n, 2) m
  Eigen::MatrixXd velocity;      ///< (n, 2) m/s
  Eigen::MatrixXd acceleration;  ///< (n, 2) m/s2
  Eigen::VectorXd force;         ///< (n) N, of the bearing, >= 0
  std::vector<ContactEvent> events;
  double without_contact     = 0;  ///< -, share of the time, from the instants of the events
  double peak_force          = 0;  ///< N, largest of `force`
  double peak_acceleration   = 0;  ///< m/s2, largest magnitude
  double static_displacement = 0;  ///< m, under the mean load
  double frequency_along     = 0;  ///< Hz, of small motions about it along the mean load; 0 without a mean load
  double frequency_across    = 0;  ///< Hz, likewise across
  Spectrum spectrum;               ///< of the acceleration along `direction`, m/s2 per sqrt(Hz)
  Spectrum force_spectrum;         ///< of the force of the bearing, N per sqrt(Hz)
  double spectrum_peak = 0;        ///< Hz, the highest line of `spectrum`
  long steps           = 0;        ///< of the integrator
  std::vector<std::string> notes;  ///< remarks on this motion, one sentence each
};

/// Integrates with an error bound on every step (CVODE: Adams formulas of order 1 to 12, Newton with the exact
/// Jacobian).  Loss and return of the contact are found as zeros of  |x| - clearance , and the formulas start
/// again there, since the force has no second derivative at that place; a step never runs across a break of the
/// record.
///
/// @param duration     s, > 0; not longer than the record
/// @param output_rate  Hz, > 0
/// @throws InputError   mass not positive, damping or tolerance out of range, a force without direction or
///                      frequency, record shorter than the duration, more than 5e7 outputs; errors of bearing_law
/// @throws SolverError  the integrator gives up; says when and why
/// Cost: 100 to 400 steps of 4 us per period of the bearing, the more where its contact comes and goes.
/// Source: A. C. Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363 (SUNDIALS).
BearingResponse simulate(const BearingOscillator &oscillator, double duration, double output_rate);

/// time [s], x [m], y [m], force [N], acceleration_x [m/s2], acceleration_y [m/s2].
Table bearing_response_table(const BearingResponse &response);
/// frequency [Hz], acceleration [g/sqrt(Hz)], force [N/sqrt(Hz)].
Table bearing_spectrum_table(const BearingResponse &response);
}  // namespace mill::dynamics
