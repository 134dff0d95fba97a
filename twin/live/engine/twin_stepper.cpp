#include "twin/live/engine/twin_stepper.h"

namespace mill::live {
TwinStepper::TwinStepper(const SteppedStand &stand, const double rate, const double force) : step_(1 / rate)
{
  prepare(stand);
  rest_at(force);
}

// x = [w q; q'] of state_space(): w is read off its upper right block, V is that of the same modes.
void TwinStepper::prepare(const SteppedStand &stand)
{
  const dynamics::StateSpace &system = stand.system;
  const Eigen::Index k               = stand.frequency.size();
  V_                                 = stand.shape;
  scale_                             = system.A.topRightCorner(k, k).diagonal();
  from_state_                        = V_ * scale_.cwiseInverse().asDiagonal();
  to_modes_                          = stand.to_modes;
  place_                             = stand.point * scale_.cwiseInverse().asDiagonal();
  still_                             = stand.still;
  still_places_                      = stand.point * (to_modes_ * still_);
  stepper_                           = std::make_unique<dynamics::HoldStepper>(system, 0);
  output_.resize(system.C.rows());
}

void TwinStepper::rest_at(const double force)
{
  reference_ = last_ = force;
  stepper_->set_state(Eigen::VectorXd::Zero(2 * V_.cols()));
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
  return from_state_ * stepper_->state().head(V_.cols());
}

Eigen::VectorXd TwinStepper::velocity() const
{
  return V_ * stepper_->state().tail(V_.cols());
}

Eigen::VectorXd TwinStepper::displacement_from(const double force) const
{
  return place_ * stepper_->state().head(V_.cols()) - still_places_ * (force - reference_);  // (48.3)
}

void TwinStepper::refer_to(const double force)
{
  const Eigen::VectorXd y = displacement() - still_ * (force - reference_), v = velocity();
  reference_ = force;
  set_motion(y, v);
}

void TwinStepper::change(const SteppedStand &stand)
{
  const Eigen::VectorXd y = displacement(), v = velocity();
  prepare(stand);
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
  Eigen::VectorXd x(2 * V_.cols());
  x << scale_.cwiseProduct(to_modes_ * y), to_modes_ * v;  // (48.4)
  stepper_->set_state(x);
}
}  // namespace mill::live
