#include "reduce/fe_masses.h"
#include "core/errors.h"
#include "reduce/mass_breakdown.h"
#include "reduce/roll_body.h"
#include "reduce/six_masses.h"
#include "reduce/stand_modes.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
double roll_flexibility(const Component &component, const std::string &reference)
{
  const RollBody roll  = component_roll(component.name, component);
  const Eigen::Index n = roll.K.rows();
  Eigen::Index seat;
  roll.seat.maxCoeff(&seat);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < n; ++i)
    if (i != seat)
      free.push_back(i);
  // An even load works on the mean, which is the coefficient of P_0: the first unknown.
  const Eigen::MatrixXd K = roll.K(free, free);
  const Eigen::VectorXd u = K.ldlt().solve(Eigen::VectorXd::Unit(n - 1, 0));
  Eigen::VectorXd y       = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < free.size(); ++i)
    y[free[i]] = u[Eigen::Index(i)];
  return reference == "mean" ? y[0] : axis_row(roll, 0).dot(y);  // (22.13)
}

StandShapes stand_shapes(const StandModel &model)
{
  const Eigen::VectorXd y = static_displacement(load_path(model));
  const auto shape        = [&](const std::string &name) {
    const auto line =
        std::find_if(model.lines.begin(), model.lines.end(), [&](const StandLine &l) { return l.name == name; });
    if (line == model.lines.end())
      throw InputError("stand model \"" + model.name + "\" has no line \"" + name + "\"");
    const double sign = name.compare(0, 5, "lower") == 0 ? -1 : 1;  // away from the bite counts positive
    return RollShape{line->z, sign * (line->rows * y)};
  };
  return {shape("upper work roll"), shape("lower work roll"), shape("upper backup roll"),
          shape("lower backup roll")};
}

FeMasses fe_masses(const FourHigh &stand, const StandModel &model, const std::string &reference)
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

double value_at(const RollShape &shape, const double x, const double kink)
{
  // Stations on the side of the kink that x lies on; the station at the kink belongs to both.
  const Eigen::VectorXd &z = shape.x;
  const double slack       = 1e-9 * z[z.size() - 1];
  Eigen::Index first = 0, last = z.size() - 1;
  if (x <= kink)
    last = std::upper_bound(z.begin(), z.end(), kink + slack) - z.begin() - 1;
  else
    first = std::lower_bound(z.begin(), z.end(), kink - slack) - z.begin();
  if (last - first < 1) {
    first = 0;
    last  = z.size() - 1;
  }
  const Eigen::Index n     = std::min<Eigen::Index>(4, last - first + 1);
  const Eigen::Index above = std::upper_bound(z.begin() + first, z.begin() + last + 1, x) - z.begin();
  const Eigen::Index begin = std::clamp<Eigen::Index>(above - n / 2, first, last - n + 1);
  double value             = 0;
  for (Eigen::Index i = begin; i < begin + n; ++i) {
    double weight = 1;
    for (Eigen::Index k = begin; k < begin + n; ++k)
      if (k != i)
        weight *= (x - z[k]) / (z[i] - z[k]);
    value += weight * shape.value[i];
  }
  return value;
}
}  // namespace mill::reduce
