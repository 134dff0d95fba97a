#pragma once
#include "dynamics/response/hold_stepper.h"
#include "twin/live/engine/stepped_stand.h"
#include <Eigen/Core>
#include <memory>

namespace mill::live {
/// The stand, one sample of force after the other: the first-order hold of chapter 7.  theory.md 48.1, 48.2
/// Displacements y count from the static state under the reference force.
class TwinStepper {
public:
  /// At rest under `force` (N), which is the reference.
  TwinStepper(const SteppedStand &stand, double rate, double force);

  /// Equilibrium under `force`, which becomes the reference.
  void rest_at(double force);
  /// One sample further: the force runs straight from the last one to this (N).
  void advance(double force);
  /// (m) m/s2 of the places under the last force.
  void acceleration(Eigen::Ref<Eigen::VectorXd> a);

  Eigen::VectorXd displacement() const;  ///< (n) m, y
  Eigen::VectorXd velocity() const;      ///< (n) m/s, y'
  /// (m) y of the places from the static state under another force (N).
  Eigen::VectorXd displacement_from(double force) const;
  /// Counts y from the static state under another force (N); the motion goes on as it is.  (48.3)
  void refer_to(double force);
  /// Other springs or damping under the motion as it is: y and y' are carried over.  (48.4)
  void change(const SteppedStand &stand);
  /// Goes on from stored values.
  void resume(const Eigen::VectorXd &displacement, const Eigen::VectorXd &velocity, double reference,
              double last_force);

  double reference() const
  {
    return reference_;
  }
  double last_force() const
  {
    return last_;
  }
  const std::string &note() const
  {
    return stepper_->note();
  }

private:
  void prepare(const SteppedStand &stand);
  void set_motion(const Eigen::VectorXd &y, const Eigen::VectorXd &v);

  double step_, reference_ = 0, last_ = 0;
  Eigen::MatrixXd from_state_;  // (n, k) y = from_state x_1, y' = V x_2
  Eigen::MatrixXd V_, to_modes_;
  Eigen::MatrixXd place_;         // (m, k) of x_1
  Eigen::VectorXd scale_;         // (k) w
  Eigen::VectorXd still_;         // (n) m/N
  Eigen::VectorXd still_places_;  // (m) m/N
  std::unique_ptr<dynamics::HoldStepper> stepper_;
  Eigen::VectorXd output_;
};
}  // namespace mill::live
