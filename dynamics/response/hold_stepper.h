#pragma once
#include "dynamics/response/time_integration.h"
#include <memory>

namespace mill::dynamics {
/// first_order_hold() one straight stretch of force after the other, for records longer than memory: in the same
/// forms.
class HoldStepper {
public:
  /// At rest in the equilibrium under the first force.  @throws SolverError as first_order_hold()
  HoldStepper(const StateSpace &system, double first_force, HoldForm wanted = HoldForm::modal);
  ~HoldStepper();
  HoldStepper(const HoldStepper &)            = delete;
  HoldStepper &operator=(const HoldStepper &) = delete;

  /// @param length  s;  @param F0, F1  N, at its two ends
  void advance(double length, double F0, double F1);
  /// (m) outputs under the force that acts now.
  void output(double force, Eigen::Ref<Eigen::VectorXd> column) const;

  /// (s) state in the coordinates of the system.
  Eigen::VectorXd state() const;
  /// Goes on from this state; what was prepared for lengths of steps stays.
  void set_state(const Eigen::VectorXd &state);

  HoldForm form() const;
  const std::string &note() const;  ///< why the form is not the wanted one; empty when it is

private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace mill::dynamics
