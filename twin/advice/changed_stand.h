#pragma once
#include "twin/advice/joined_stand.h"
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mill::twin {
/// What an action does to a stand, dampers that it adds left aside.
struct StandChange {
  std::vector<std::pair<std::string, double>> springs;  ///< factors on springs by their names
  double damping = 1;                                   ///< -, factor on the ratios of all modes
  double force   = 1;                                   ///< -, factor on the rolling force, which contacts follow
};

/// The stand without spring and damper of the bite after a change; nothing where it cannot be had (a spring that
/// is several parts of it).
using OpenStand = std::function<std::optional<VibratingStand>(const StandChange &)>;

/// The chain with one of its springs times a factor.
dynamics::MillModel with_spring_scaled(dynamics::MillModel model, const std::string &name, double factor);

/// A chain without spring and damper of the bite after a change.
/// @param model    at the force of the change
/// @param damping  (n) -, ratios of critical before it
VibratingStand open_stand(dynamics::MillModel model, const Eigen::VectorXd &damping, const StandChange &change);
}  // namespace mill::twin
