#include "reduce/bite/quadrature.h"
#include <cmath>

namespace mill::bite {
namespace {
/// Points crowd at +1:  node = 1 - 2 u^q,  u in 0..1.
GaussRule graded(const int n, const double q)
{
  GaussRule rule = gauss_legendre(n);
  for (int i = 0; i < n; ++i) {
    const double u = 0.5 * (1 + rule.node[i]);
    rule.node[i]   = 1 - 2 * std::pow(u, q);
    rule.weight[i] *= q * std::pow(u, q - 1);
  }
  return rule;
}

bool starts_steeply(const RollBite &bite)
{
  const double h1      = bite.strip.entry_thickness;
  const double h0      = std::isnan(bite.strip.initial_thickness) ? h1 : bite.strip.initial_thickness;
  const double of_pass = std::log(h1 / bite.strip.exit_thickness);
  return strain_from_branch(bite.strip.flow_stress, std::log(h0 / h1)) < 0.5 * of_pass;
}
}  // namespace

HillRules even_rules(const int n)
{
  return {gauss_legendre(n), gauss_legendre(n)};
}

const HillRules &hill_rules(const RollBite &bite)
{
  static const HillRules smooth = even_rules(12), steep = {gauss_legendre(12), graded(24, 5)};
  return starts_steeply(bite) ? steep : smooth;
}
}  // namespace mill::bite
