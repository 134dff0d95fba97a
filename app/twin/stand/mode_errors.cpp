#include "app/twin/stand/mode_errors.h"
#include "app/verbs/known_modes.h"
#include <cmath>
#include <limits>

namespace mill {
Eigen::VectorXd mode_errors_of_run(const Case &the_case, const Eigen::VectorXd &frequency)
{
  constexpr double same  = 0.02;  // -, of one mode in both models
  Eigen::VectorXd error  = Eigen::VectorXd::Constant(frequency.size(), std::numeric_limits<double>::quiet_NaN());
  const KnownModes known = known_modes(the_case, "");
  if (!known.note.empty())
    return error;
  for (Eigen::Index i = 0; i < frequency.size(); ++i)
    for (const CampbellMode &mode : known.modes)
      if (std::abs(mode.frequency / frequency[i] - 1) < same && mode.error_estimate > 0)
        error[i] = mode.error_estimate;
  return error;
}
}  // namespace mill
