#include "twin/calibration/fitted_stand.h"
#include "core/case/errors.h"
#include "core/numerics/require.h"
#include "dynamics/response/response_slopes.h"
#include <cmath>
#include <cstdlib>

namespace mill::twin {
namespace {
/// Number of the mode of "f2" or "zeta2", from 0; -1: none.
Eigen::Index mode_of(const std::string &name, const std::string &head, const Eigen::Index n)
{
  if (name.size() <= head.size() || name.compare(0, head.size(), head) != 0)
    return -1;
  const Eigen::Index i = std::atoi(name.c_str() + head.size()) - 1;
  return i >= 0 && i < n ? i : -1;
}

dynamics::Spring *spring_of(dynamics::MillModel &chain, const std::string &name)
{
  for (dynamics::Spring &spring : chain.springs)
    if (spring.name == name && spring.stiffness > 0)
      return &spring;
  return nullptr;
}

void put_springs_together(dynamics::MillModel &chain)
{
  chain.K.setZero();
  for (const dynamics::Spring &s : chain.springs) {
    if (s.from != dynamics::ground)
      chain.K(s.from, s.from) += s.stiffness;
    if (s.to != dynamics::ground)
      chain.K(s.to, s.to) += s.stiffness;
    if (s.from != dynamics::ground && s.to != dynamics::ground) {
      chain.K(s.from, s.to) -= s.stiffness;
      chain.K(s.to, s.from) -= s.stiffness;
    }
  }
}

/// Ratios, frequencies, gain and delay at theta; springs are in the modes already.
void apply_modal(StandAt &at, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta)
{
  const Eigen::Index n = at.frequency.size();
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const std::string &name = unknowns[p].name;
    const double factor     = std::exp(theta[Eigen::Index(p)]);
    if (name == "zeta")
      at.damping *= factor;
    else if (const auto i = mode_of(name, "zeta", n); i >= 0)
      at.damping[i] *= factor;
    else if (const auto k = mode_of(name, "f", n); k >= 0)
      at.frequency[k] *= factor;
    else if (name == "gain")
      at.force *= factor;
    else if (name == "delay")
      at.delay = theta[Eigen::Index(p)];
  }
}

/// What unknown `name` adds to the dynamic stiffness in the modes.  theory.md (44.3)
void add_change(StandAt &at, const dynamics::SlopedStand &slopes, const std::string &name)
{
  const Eigen::Index n = at.frequency.size();
  Eigen::MatrixXd K, C;
  for (std::size_t s = 0; s < slopes.names.size(); ++s)
    if (slopes.names[s] == name) {
      K = slopes.stiffness[s];
      C.resize(n, n);
      for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = 0; b < n; ++b)
          C(a, b) =
              K(a, b) * dynamics::damping_quotient(at.frequency[a], at.damping[a], at.frequency[b], at.damping[b]);
    }
  const auto ratio = mode_of(name, "zeta", n), mode = mode_of(name, "f", n);
  if (name == "zeta" || ratio >= 0 || mode >= 0) {
    K = C = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double damper = 2 * at.damping[i] * at.frequency[i];
      if (i == mode)
        K(i, i) = 2 * at.frequency[i] * at.frequency[i];
      if (i == mode || i == ratio || name == "zeta")
        C(i, i) = damper;
    }
  }
  at.stiffness.push_back(K);
  at.damper.push_back(C);
}
}  // namespace

StandAt stand_at(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta)
{
  require(theta.size() == Eigen::Index(unknowns.size()), "one theta for each unknown");
  dynamics::MillModel chain = stand.chain;
  const Eigen::Index n      = stand.damping.size();
  bool springs = false, frequencies = false;
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const std::string &name = unknowns[p].name;
    frequencies             = frequencies || mode_of(name, "f", n) >= 0;
    if (dynamics::Spring *spring = spring_of(chain, name)) {
      spring->stiffness *= std::exp(theta[Eigen::Index(p)]);
      springs = true;
    } else if (name != "zeta" && name != "gain" && name != "delay" && mode_of(name, "zeta", n) < 0 &&
               mode_of(name, "f", n) < 0)
      throw InputError("\"" + name + "\" is nothing of this chain that can be fitted");
  }
  require(!springs || !frequencies, "springs and frequencies of modes are not fitted together");
  put_springs_together(chain);
  StandAt at;
  dynamics::SlopedStand slopes = dynamics::sloped_stand(chain, stand.damping);
  at.frequency                 = slopes.frequency;
  at.damping                   = slopes.damping;
  at.force                     = slopes.force;
  at.shape                     = slopes.shape;
  apply_modal(at, unknowns, theta);
  for (const Unknown &unknown : unknowns)
    add_change(at, slopes, unknown.name);
  return at;
}
}  // namespace mill::twin
