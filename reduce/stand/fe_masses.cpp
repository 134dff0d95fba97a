#include "reduce/stand/fe_masses.h"
#include "core/base/errors.h"
#include "core/records/stand_place.h"
#include "reduce/stand/mass_breakdown.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modes.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
StandShapes stand_shapes(const StandModel &model)
{
  const Eigen::VectorXd y = static_displacement(load_path(model));
  const auto shape        = [&](const std::string &name) {
    const auto line =
        std::find_if(model.lines.begin(), model.lines.end(), [&](const StandLine &l) { return l.name == name; });
    if (line == model.lines.end())
      throw InputError("stand model \"" + model.name + "\" has no line \"" + name + "\"");
    const double sign = stand_place(name).lower ? -1 : 1;  // away from the bite is positive
    return RollShape{line->z, sign * (line->rows * y)};
  };
  return {shape("upper work roll"), shape("lower work roll"), shape("upper backup roll"),
          shape("lower backup roll")};
}

FeMasses fe_masses(const FourHigh &stand, const StandModel &model, const MassReference reference)
{
  const auto parts    = model_breakdown(stand, model, reference);
  const SixMasses six = six_masses(model, riders_of(stand), reference);
  FeMasses masses{};
  for (std::size_t i = 0; i < 4; ++i) {
    masses.integral[i] = parts[i + 1].value;  // (22.14)
    masses.solid[i]    = six.M[i + 1];        // (22.15)
  }
  return masses;
}
}  // namespace mill::reduce
