#include "reduce/stack/line_law.h"
#include <cmath>
#include <limits>

namespace mill::reduce {
namespace {
double plane_compliance(const Material &m)
{
  return 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
}
}  // namespace

LineLaw line_law(const double radius_a, const Material &a, const double radius_b, const Material &b,
                 const double ring_stiffness)
{
  return {{radius_a, radius_b},
          {plane_compliance(a), plane_compliance(b)},
          std::isnan(ring_stiffness) ? 0 : 1 / ring_stiffness};
}

double half_width_of(const LineLaw &law, const double load)
{
  const double R = law.radius[0] * law.radius[1] / (law.radius[0] + law.radius[1]);
  return std::sqrt(2 * load * R * (law.compliance[0] + law.compliance[1]));  // b^2 = 4 q R / (pi E*)
}

double approach_of(const LineLaw &law, const double load)
{
  if (!(load > 0))
    return 0;
  const double b = half_width_of(law, load);
  double sum     = law.ring * load;
  for (std::size_t i = 0; i < 2; ++i)
    sum += law.compliance[i] * load * (std::log(4 * law.radius[i] / b) - 0.5);
  return sum;
}

double compliance_of(const LineLaw &law, const double load)
{
  const double b = half_width_of(law, load);
  double sum     = law.ring;
  for (std::size_t i = 0; i < 2; ++i)
    sum += law.compliance[i] * (std::log(4 * law.radius[i] / b) - 1);
  return sum;
}

LineLoad line_load(const LineLaw &law, const double approach)
{
  if (!(approach > 0))
    return {};
  // The law is almost straight: secant steps on q / compliance, then Newton, keep the load positive.
  double q = approach / (law.ring + 6 * (law.compliance[0] + law.compliance[1]));
  for (int step = 0; step < 50; ++step) {
    const double next = q + (approach - approach_of(law, q)) / compliance_of(law, q);
    const double held = next > 0.1 * q ? next : 0.1 * q;
    const bool done   = std::abs(held - q) <= 4 * std::numeric_limits<double>::epsilon() * q;
    q                 = held;
    if (done)
      break;
  }
  return {q, 1 / compliance_of(law, q)};
}
}  // namespace mill::reduce
