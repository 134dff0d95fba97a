#include "reduce/chain/mill_modulus.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include "core/numerics/root_search.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
MillModulus mill_modulus(const std::vector<PathPart> &path)
{
  MillModulus all;
  double tangent = 0, secant = 0, most = 0;
  for (const PathPart &part : path) {
    if (!(part.tangent > 0 && part.secant > 0))
      throw InputError(part.name + " must be positive: it is one of the springs in series between the rolls");
    tangent += 1 / part.tangent;
    secant += 1 / part.secant;
    if (1 / part.tangent > most) {
      most                = 1 / part.tangent;
      all.softest         = part.name;
      all.softest_tangent = part.tangent;
    }
  }
  all.tangent = 1 / tangent;
  all.secant  = 1 / secant;
  for (const PathPart &part : path) {
    all.error += all.tangent / part.tangent * part.error;  // stays unknown where one of them is
    if (!std::isnan(part.error))
      continue;
    const std::vector<std::string> springs{part.name};
    for (const std::string &lack : part.error_lacks.empty() ? springs : part.error_lacks)
      if (std::find(all.lacks.begin(), all.lacks.end(), lack) == all.lacks.end())
        all.lacks.push_back(lack);
  }
  return all;
}

double modulus_by_width(const double modulus, const double flattening, const double width,
                        const double bending_slope)
{
  return -modulus * modulus * (-2 / (flattening * width) + bending_slope);
}

Deflected deflected_at(const LoadDeflection &part, const double load)
{
  const Eigen::Index n = part.load.size();
  if (n < 2 || !(load > 0))
    throw InputError("a load-deflection curve needs two samples and a positive load");
  // ln d over ln F has the slope F / (d K): secant over tangent.
  const auto slope = [&](const Eigen::Index i) { return part.load[i] / (part.deflection[i] * part.tangent[i]); };
  const double x   = std::log(load);
  double y = 0, dy = 0;
  const auto beyond = [&](const Eigen::Index i) {
    dy = slope(i);
    y  = std::log(part.deflection[i]) + dy * (x - std::log(part.load[i]));
  };
  if (load <= part.load[0])
    beyond(0);
  else if (load >= part.load[n - 1])
    beyond(n - 1);
  else {
    const Eigen::Index i = std::upper_bound(part.load.begin(), part.load.end(), load) - part.load.begin() - 1;
    const double x0 = std::log(part.load[i]), h = std::log(part.load[i + 1]) - x0, t = (x - x0) / h;
    const double y0 = std::log(part.deflection[i]), y1 = std::log(part.deflection[i + 1]);
    const double a = h * slope(i) - (y1 - y0), b = -h * slope(i + 1) + (y1 - y0);
    y  = (1 - t) * y0 + t * y1 + t * (1 - t) * (a * (1 - t) + b * t);
    dy = (y1 - y0 + (1 - 2 * t) * (a * (1 - t) + b * t) + t * (1 - t) * (b - a)) / h;
  }
  const double deflection = std::exp(y);
  return {deflection, dy * deflection / load};
}

double work_roll_bending(const BentWorkRoll &roll, const double contact_stiffness, const double half_barrel,
                         const MassReference reference)
{
  if (reference != MassReference::mean)
    return roll.deflection(0) - 1 / contact_stiffness;  // (30.3)
  const GaussRule rule = gauss_legendre(20);
  const double end     = std::min(roll.half_strip, half_barrel);
  double mean          = 0;
  for (Eigen::Index i = 0; i < rule.node.size(); ++i)
    mean += 0.5 * rule.weight[i] * roll.deflection(0.5 * end * (1 + rule.node[i]));
  return mean - 1 / contact_stiffness;
}

double GaugeCoupling::screw() const
{
  return M / (M + Q);
}

double GaugeCoupling::thickness_by(const double F_x) const
{
  return F_x / (M + Q);
}

double GaugeCoupling::force_by(const double F_x) const
{
  return M * F_x / (M + Q);
}

double GaugeCoupling::force_by_screw() const
{
  return -M * Q / (M + Q);
}

double coupled_thickness(const double screw, const std::function<double(double)> &force,
                         const std::function<double(double)> &stretch, const double low, const double high)
{
  const auto excess    = [&](const double h) { return h - screw - stretch(force(h)); };  // rises with h
  const auto thickness = root_between(low, high, excess);
  if (!thickness)
    throw InputError("no thickness in the range carries the force of the stand's stretch");
  return *thickness;
}
}  // namespace mill::reduce
