#include "reduce/bite/schedule/hardening_fit.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
namespace {
void require_points(const std::vector<HardeningPoint> &points)
{
  if (points.size() < 2)
    throw InputError(sentence("a hardening law of two constants cannot be found from ", points.size(),
                              points.size() == 1 ? " pass" : " passes",
                              " with a force: more unknowns than data; fit the flow stress of the pass instead"));
  double least = INFINITY, largest = 0;
  for (const HardeningPoint &p : points) {
    if (!(p.strain > 0))
      throw InputError(
          sentence("pass \"", p.pass, "\": strain ", p.strain,
                   " against the strip before hardening; the law Y ln(h0/h_out)^n needs an exit thinner "
                   "than h0"));
    if (!(p.flow_stress > 0))
      throw InputError(
          sentence("pass \"", p.pass, "\": flow stress ", p.flow_stress / 1e6, " MPa must be positive"));
    least   = std::min(least, p.strain);
    largest = std::max(largest, p.strain);
  }
  if (!(largest > least * (1 + 1e-9)))
    throw InputError(sentence("a hardening law needs passes of different strain; all have ", least));
}
}  // namespace

double HardeningFit::flow_stress(const double strain) const
{
  return 2 * Y * std::pow(strain, n);
}

HardeningFit fit_hardening(const std::vector<HardeningPoint> &points)
{
  require_points(points);
  const double m = double(points.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, misfit = 0;
  for (const HardeningPoint &p : points) {
    mean_x += std::log(p.strain) / m;
    mean_y += std::log(0.5 * p.flow_stress) / m;
  }
  for (const HardeningPoint &p : points) {
    const double x = std::log(p.strain) - mean_x;
    xx += x * x;
    xy += x * (std::log(0.5 * p.flow_stress) - mean_y);
  }
  HardeningFit fit;
  fit.data = int(points.size());
  fit.n    = xy / xx;
  fit.Y    = std::exp(mean_y - fit.n * mean_x);
  for (const HardeningPoint &p : points) {
    const double ratio = fit.flow_stress(p.strain) / p.flow_stress;
    fit.misfit.push_back(ratio - 1);
    misfit += std::log(ratio) * std::log(ratio);
  }
  if (fit.data > fit.unknowns) {
    const double variance = misfit / (fit.data - fit.unknowns);
    fit.n_deviation       = std::sqrt(variance / xx);
    fit.Y_deviation       = std::sqrt(variance * (1 / m + mean_x * mean_x / xx));
  }
  return fit;
}
}  // namespace mill::bite
