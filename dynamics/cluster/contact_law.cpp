#include "dynamics/cluster/contact_law.h"
#include <algorithm>
#include <cmath>

namespace mill::cluster {
namespace {
// Line load of d = q (S - T ln q): rises up to ln q = S/T - 1, far beyond what a roll carries.
double line_load(const ContactLaw &law, const double d)
{
  if (d <= 0)
    return 0;
  double q = d / law.S;
  for (int k = 0; k < 3; ++k)
    q = d / (law.S - law.T * std::log(q));
  for (int k = 0; k < 20; ++k) {
    const double log_q = std::log(q), slope = law.S - law.T * (log_q + 1);
    const double change = (q * (law.S - law.T * log_q) - d) / slope;
    q -= change;
    if (std::abs(change) <= 1e-15 * q)
      break;
  }
  return q;
}
}  // namespace

ContactLaw straight_law(const double stiffness)
{
  ContactLaw law;
  law.k = stiffness;
  return law;
}

ContactLaw palmgren_law(const double length, const double coefficient)
{
  const double kappa = coefficient * 1e-3 / std::pow(1e3 * length, 0.8);
  ContactLaw law;
  law.p = 10. / 9;
  law.k = std::pow(kappa, -law.p);
  return law;
}

ContactLaw power_law_through(const double tangent, const double force, const double exponent)
{
  if (exponent == 1)
    return straight_law(tangent);
  ContactLaw law;
  law.p = exponent;
  law.k = force / std::pow(exponent * force / tangent, exponent);
  return law;
}

ContactLaw line_law(const LineForm form, const ContactBody &a, const ContactBody &b, const double length)
{
  const double factor = form == LineForm::foeppl ? 2 : 4, constant = form == LineForm::foeppl ? 1. / 3 : -0.5;
  const auto plane = [](const Material &m) { return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus; };
  // half width^2 = w q
  const double w = 4 / M_PI * (plane(a.material) + plane(b.material)) / (1 / a.radius + 1 / b.radius);
  ContactLaw law;
  law.form   = ContactLaw::Form::line;
  law.length = length;
  for (const ContactBody *body : {&a, &b}) {
    const double A = 2 / M_PI * plane(body->material);
    law.S += A * (std::log(factor * body->radius) - 0.5 * std::log(w) + constant);
    law.T += 0.5 * A;
  }
  return law;
}

ContactLaw fitted_line_law(const double *load, const double *approach, const int n, const double length,
                           double &misfit)
{
  // d/q = S - T ln q is a straight line in ln q; weights make the errors relative.
  double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
  for (int i = 0; i < n; ++i) {
    const double q = load[i] / length, x = std::log(q), y = approach[i] / q, weight = 1 / (y * y);
    w += weight;
    wx += weight * x;
    wxx += weight * x * x;
    wy += weight * y;
    wxy += weight * x * y;
  }
  ContactLaw law;
  law.form   = ContactLaw::Form::line;
  law.length = length;
  law.T      = -(w * wxy - wx * wy) / (w * wxx - wx * wx);
  law.S      = (wy + law.T * wx) / w;
  misfit     = 0;
  for (int i = 0; i < n; ++i)
    misfit = std::max(misfit, std::abs(cluster::approach(law, load[i]) / approach[i] - 1));
  return law;
}

double force(const ContactLaw &law, const double approach)
{
  if (approach <= 0)
    return 0;
  if (law.form == ContactLaw::Form::line)
    return law.length * line_load(law, approach);
  return law.p == 1 ? law.k * approach : law.k * std::pow(approach, law.p);
}

double tangent(const ContactLaw &law, const double approach)
{
  if (approach < 0)
    return 0;
  if (law.form == ContactLaw::Form::line) {
    const double q = line_load(law, approach);
    return q > 0 ? law.length / (law.S - law.T * (std::log(q) + 1)) : 0;
  }
  return law.p == 1 ? law.k : law.k * law.p * std::pow(approach, law.p - 1);
}

double approach(const ContactLaw &law, const double force)
{
  if (force <= 0)
    return 0;
  if (law.form == ContactLaw::Form::line) {
    const double q = force / law.length;
    return q * (law.S - law.T * std::log(q));
  }
  return std::pow(force / law.k, 1 / law.p);
}

double energy(const ContactLaw &law, const double approach)
{
  if (approach <= 0)
    return 0;
  if (law.form == ContactLaw::Form::line) {
    // d q - integral of d over q
    const double q = line_load(law, approach);
    return law.length * (approach * q - 0.5 * q * q * (law.S - law.T * (std::log(q) - 0.5)));
  }
  return law.k * std::pow(approach, law.p + 1) / (law.p + 1);
}

double step(const double z, const double a, const double h0, const double b, const double h1)
{
  if (z <= a)
    return h0;
  if (z >= b)
    return h1;
  const double s = (z - a) / (b - a);
  return h0 + (h1 - h0) * s * s * (3 - 2 * s);
}

double impact_force(const ContactLaw &law, const double approach, const double rate, const double damping,
                    const double depth)
{
  if (approach <= 0)
    return 0;
  const double share = depth > 0 ? step(approach, 0, 0, depth, 1) : 1;
  return std::max(0., force(law, approach) + damping * rate * share);
}
}  // namespace mill::cluster
