#include "dynamics/response/response_slopes.h"
#include "core/base/require.h"
#include "dynamics/response/modes.h"
#include <cmath>
#include <complex>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

Eigen::MatrixXcd changed_dynamics(const SlopedStand &s, const std::size_t p, const double w)
{
  const Eigen::Index n     = s.frequency.size();
  const Eigen::MatrixXd &k = s.stiffness[p], &m = s.mass[p];
  Eigen::MatrixXcd A(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const double wa = s.frequency[a], wb = s.frequency[b];
      const double Z  = damping_quotient(wa, s.damping[a], wb, s.damping[b]);
      const double dk = k.size() ? k(a, b) : 0, dm = m.size() ? m(a, b) : 0;
      const double dc = dm * 2 * s.damping[b] * wb + Z * (dk - dm * wb * wb);
      A(a, b)         = Complex(dk - w * w * dm, w * dc);
    }
  return A;
}
}  // namespace

double damping_quotient(const double wa, const double za, const double wb, const double zb)
{
  // zeta_a w_a - zeta_b w_b = zm (w_a - w_b) + (z_a - z_b) wm with means zm, wm: no cancellation for equal ratios.
  const double ratio = 0.5 * (za + zb), change = za - zb;
  const double equal = 2 * ratio / (wa + wb);
  return change == 0 || wa == wb ? equal : equal + change / (wa - wb);
}

SlopedStand sloped_stand(const MillModel &model, const Eigen::VectorXd &damping)
{
  const Modes natural = modes(model);
  require(damping.size() == natural.frequency.size(), "every mode needs a damping ratio");
  SlopedStand s;
  s.frequency = 2 * M_PI * natural.frequency;
  s.shape     = natural.shape;
  s.damping   = damping;
  s.force     = natural.shape.transpose() * model.b;
  for (const Spring &spring : model.springs) {
    if (!(spring.stiffness > 0))
      continue;
    Eigen::VectorXd strain = Eigen::VectorXd::Zero(natural.shape.cols());
    if (spring.from != ground)
      strain += natural.shape.row(spring.from).transpose();
    if (spring.to != ground)
      strain -= natural.shape.row(spring.to).transpose();
    s.names.push_back(spring.name);
    s.stiffness.push_back(spring.stiffness * strain * strain.transpose());
    s.mass.emplace_back();
  }
  for (Eigen::Index i = 0; i < model.M.size(); ++i) {
    const Eigen::VectorXd row = natural.shape.row(i).transpose();
    s.names.push_back("M" + std::to_string(i + 1));
    s.stiffness.emplace_back();
    s.mass.push_back(model.M[i] * row * row.transpose());
  }
  return s;
}

ResponseSlopes response_slopes(const SlopedStand &s, const Eigen::MatrixXd &seen, const double w)
{
  const Eigen::Index n = s.frequency.size(), places = seen.rows();
  const Eigen::VectorXcd d = Eigen::VectorXcd::NullaryExpr(n, [&](const Eigen::Index i) {
    return Complex((s.frequency[i] - w) * (s.frequency[i] + w), 2 * s.damping[i] * s.frequency[i] * w);
  });
  const Eigen::VectorXcd x = s.force.cast<Complex>().cwiseQuotient(d);  // (43.2)
  ResponseSlopes r;
  r.value = -w * w * (seen * x);
  r.parameters.resize(places, Eigen::Index(s.names.size()));
  for (std::size_t p = 0; p < s.names.size(); ++p)  // (43.3)
    r.parameters.col(Eigen::Index(p)) = w * w * (seen * (changed_dynamics(s, p, w) * x).cwiseQuotient(d));
  r.dampings.resize(places, n);
  for (Eigen::Index i = 0; i < n; ++i)  // (43.6)
    r.dampings.col(i) = w * w * Complex(0, 2 * s.damping[i] * s.frequency[i] * w) * x[i] / d[i] * seen.col(i);
  return r;
}
}  // namespace mill::dynamics
