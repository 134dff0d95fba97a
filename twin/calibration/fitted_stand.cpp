#include "twin/calibration/fitted_stand.h"
#include "core/base/errors.h"
#include "core/base/require.h"
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

const dynamics::Spring *spring_of(const dynamics::MillModel &chain, const std::string &name)
{
  for (const dynamics::Spring &spring : chain.springs)
    if (spring.name == name && spring.stiffness > 0)
      return &spring;
  return nullptr;
}

const ReducedSpring *spring_of(const ReducedStand &stand, const std::string &name)
{
  for (const ReducedSpring &spring : stand.springs)
    if (spring.name == name)
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

/// ln of the factor on a spring; 0 where it is no unknown.
double theta_of(const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta, const std::string &name)
{
  for (std::size_t p = 0; p < unknowns.size(); ++p)
    if (unknowns[p].name == name)
      return theta[Eigen::Index(p)];
  return 0;
}

dynamics::SlopedStand slopes_at(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                const Eigen::VectorXd &theta)
{
  if (!stand.detailed) {
    dynamics::MillModel chain = stand.chain;
    for (dynamics::Spring &spring : chain.springs)
      spring.stiffness *= std::exp(theta_of(unknowns, theta, spring.name));
    put_springs_together(chain);
    return dynamics::sloped_stand(chain, stand.damping);
  }
  Eigen::VectorXd factor(Eigen::Index(stand.detailed->springs.size()));
  for (Eigen::Index s = 0; s < factor.size(); ++s)
    factor[s] = std::exp(theta_of(unknowns, theta, stand.detailed->springs[std::size_t(s)].name));
  return sloped_stand(*stand.detailed, factor, stand.damping);
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

Eigen::VectorXd mode_frequencies(const FittedStand &stand)
{
  return slopes_at(stand, {}, {}).frequency / (2 * M_PI);
}

Eigen::Index number_of_places(const FittedStand &stand)
{
  return stand.detailed ? stand.detailed->point.rows() : stand.chain.M.size();
}

bool is_spring(const FittedStand &stand, const std::string &name)
{
  return stand.detailed ? spring_of(*stand.detailed, name) != nullptr : spring_of(stand.chain, name) != nullptr;
}

bool share_a_part(const FittedStand &stand, const std::string &a, const std::string &b)
{
  if (!is_spring(stand, a) || !is_spring(stand, b))
    return false;
  std::set<int> parts;
  for (const std::string &name : {a, b}) {
    std::set<int> own;
    if (stand.detailed)
      own = spring_of(*stand.detailed, name)->parts;
    else
      for (const int mass : {spring_of(stand.chain, name)->from, spring_of(stand.chain, name)->to})
        if (mass != dynamics::ground)
          own.insert(mass);
    for (const int part : own)
      if (!parts.insert(part).second)
        return true;
  }
  return false;
}

StandAt stand_at(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta)
{
  require(theta.size() == Eigen::Index(unknowns.size()), "one theta for each unknown");
  const Eigen::Index n = stand.damping.size();
  bool springs = false, frequencies = false;
  for (const Unknown &unknown : unknowns) {
    const std::string &name = unknown.name;
    const bool frequency = mode_of(name, "f", n) >= 0, spring = is_spring(stand, name);
    frequencies = frequencies || frequency;
    springs     = springs || spring;
    if (!spring && !frequency && name != "zeta" && name != "gain" && name != "delay" &&
        mode_of(name, "zeta", n) < 0)
      throw InputError("\"" + name + "\" is nothing of this stand that can be fitted");
  }
  require(!springs || !frequencies, "springs and frequencies of modes are not fitted together");
  StandAt at;
  const dynamics::SlopedStand slopes = slopes_at(stand, unknowns, theta);
  at.frequency                       = slopes.frequency;
  at.damping                         = slopes.damping;
  at.force                           = slopes.force;
  at.shape                           = slopes.shape;
  apply_modal(at, unknowns, theta);
  for (const Unknown &unknown : unknowns)
    add_change(at, slopes, unknown.name);
  return at;
}
}  // namespace mill::twin
