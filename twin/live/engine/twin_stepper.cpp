#include "twin/live/engine/twin_stepper.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/state_space.h"

namespace mill::live {
TwinStepper::TwinStepper(const dynamics::MillModel &model, const double rate, const double force) : step_(1 / rate)
{
  prepare(model);
  rest_at(force);
}

// x = [w q; q'] of state_space(): w is read off its upper right block, V is that of the same modes.
void TwinStepper::prepare(const dynamics::MillModel &model)
{
  const dynamics::StateSpace system = dynamics::state_space(model);
  const Eigen::Index n              = model.M.size();
  V_                                = dynamics::modes(model).shape;
  scale_                            = system.A.topRightCorner(n, n).diagonal();
  from_state_                       = V_ * scale_.cwiseInverse().asDiagonal();
  to_modes_                         = V_.transpose() * model.M.asDiagonal();
  static_                           = dynamics::static_displacement(model);
  stepper_                          = std::make_unique<dynamics::HoldStepper>(system, 0);
  output_.resize(system.C.rows());
}

void TwinStepper::rest_at(const double force)
{
  reference_ = last_ = force;
  stepper_->set_state(Eigen::VectorXd::Zero(2 * V_.rows()));
}

void TwinStepper::advance(const double force)
{
  stepper_->advance(step_, last_ - reference_, force - reference_);
  last_ = force;
}

void TwinStepper::acceleration(Eigen::Ref<Eigen::VectorXd> a)
{
  stepper_->output(last_ - reference_, output_);
  a = output_.head(a.size());
}

Eigen::VectorXd TwinStepper::displacement() const
{
  return from_state_ * stepper_->state().head(V_.rows());
}

Eigen::VectorXd TwinStepper::velocity() const
{
  return V_ * stepper_->state().tail(V_.rows());
}

Eigen::VectorXd TwinStepper::displacement_from(const double force) const
{
  return displacement() - static_ * (force - reference_);  // (48.3)
}

void TwinStepper::refer_to(const double force)
{
  const Eigen::VectorXd y = displacement_from(force), v = velocity();
  reference_ = force;
  set_motion(y, v);
}

void TwinStepper::change(const dynamics::MillModel &model)
{
  const Eigen::VectorXd y = displacement(), v = velocity();
  prepare(model);
  set_motion(y, v);
}

void TwinStepper::resume(const Eigen::VectorXd &displacement, const Eigen::VectorXd &velocity,
                         const double reference, const double last_force)
{
  reference_ = reference;
  last_      = last_force;
  set_motion(displacement, velocity);
}

void TwinStepper::set_motion(const Eigen::VectorXd &y, const Eigen::VectorXd &v)
{
  Eigen::VectorXd x(2 * V_.rows());
  x << scale_.cwiseProduct(to_modes_ * y), to_modes_ * v;  // (48.4)
  stepper_->set_state(x);
}
}  // namespace mill::live
