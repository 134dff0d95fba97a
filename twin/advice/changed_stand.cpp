#include "twin/advice/changed_stand.h"

namespace mill::twin {
dynamics::MillModel with_spring_scaled(dynamics::MillModel model, const std::string &name, const double factor)
{
  for (dynamics::Spring &spring : model.springs) {
    if (spring.name != name)
      continue;
    Eigen::VectorXd ends = Eigen::VectorXd::Zero(model.M.size());
    if (spring.from != dynamics::ground)
      ends[spring.from] = -1;
    if (spring.to != dynamics::ground)
      ends[spring.to] = 1;
    model.K += (factor - 1) * spring.stiffness * ends * ends.transpose();
    spring.stiffness *= factor;
  }
  return model;
}

VibratingStand open_stand(dynamics::MillModel model, const Eigen::VectorXd &damping, const StandChange &change)
{
  model = with_spring_scaled(std::move(model), "K4", 0);
  for (const auto &[name, factor] : change.springs)
    model = with_spring_scaled(std::move(model), name, factor);
  return vibrating_stand(model, change.damping * damping);
}
}  // namespace mill::twin
