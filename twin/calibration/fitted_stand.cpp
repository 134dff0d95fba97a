#include "twin/calibration/fitted_stand.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include "dynamics/response/response_slopes.h"
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
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

const ReducedMass *mass_of(const ReducedStand &stand, const std::string &name)
{
  for (const ReducedMass &mass : stand.masses)
    if (mass.name == name)
      return &mass;
  return nullptr;
}

std::string mass_name(const Eigen::Index i)
{
  return "M" + std::to_string(i + 1);
}

bool is_part(const FittedStand &stand, const std::string &unknown)
{
  const auto known = [&](const std::string &name) { return is_spring(stand, name) || is_mass(stand, name); };
  if (known(unknown))
    return true;
  const auto members = members_of(unknown);
  return std::all_of(members.begin(), members.end(), known);
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

bool moves(const std::string &unknown, const std::string &name)
{
  if (unknown == name)
    return true;
  const auto members = members_of(unknown);
  return std::find(members.begin(), members.end(), name) != members.end();
}

/// ln of the factor on a spring or a mass; 0 where no unknown moves it.
double theta_of(const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta, const std::string &name)
{
  for (std::size_t p = 0; p < unknowns.size(); ++p)
    if (moves(unknowns[p].name, name))
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
    for (Eigen::Index i = 0; i < chain.M.size(); ++i)
      chain.M[i] *= std::exp(theta_of(unknowns, theta, mass_name(i)));
    return dynamics::sloped_stand(chain, stand.damping);
  }
  const ReducedStand &detailed = *stand.detailed;
  Eigen::VectorXd springs(Eigen::Index(detailed.springs.size())), masses(Eigen::Index(detailed.masses.size()));
  for (Eigen::Index s = 0; s < springs.size(); ++s)
    springs[s] = std::exp(theta_of(unknowns, theta, detailed.springs[std::size_t(s)].name));
  for (Eigen::Index m = 0; m < masses.size(); ++m)
    masses[m] = std::exp(theta_of(unknowns, theta, detailed.masses[std::size_t(m)].name));
  return sloped_stand(detailed, springs, masses, stand.damping);
}

/// Ratios, frequencies, gain and delay at theta; the modes follow springs and masses already.
void apply_modal(StandAt &trial, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta)
{
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const auto [what, mode] = moved_by(unknowns[p].name);
    const double factor     = std::exp(theta[Eigen::Index(p)]);
    switch (what) {
    case Moves::parts:
      break;
    case Moves::ratios:
      trial.damping *= factor;
      break;
    case Moves::ratio:
      trial.damping[mode] *= factor;
      break;
    case Moves::frequency:
      trial.frequency[mode] *= factor;
      break;
    case Moves::gain:
      trial.force *= factor;
      break;
    case Moves::delay:
      trial.delay = theta[Eigen::Index(p)];
      break;
    }
  }
}

/// Adds what the springs and masses of an unknown change in the modes.  theory.md (43.3), (43.4)
void add_parts(const StandAt &trial, const dynamics::SlopedStand &slopes, const std::size_t part,
               Eigen::MatrixXd &K, Eigen::MatrixXd &C, Eigen::MatrixXd &M)
{
  const Eigen::Index n     = trial.frequency.size();
  const Eigen::MatrixXd &k = slopes.stiffness[part], &m = slopes.mass[part];
  for (Eigen::MatrixXd *sum : {&K, &C, m.size() ? &M : &K})
    if (sum->size() == 0)
      *sum = Eigen::MatrixXd::Zero(n, n);
  if (k.size())
    K += k;
  if (m.size())
    M += m;
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const double wb = trial.frequency[b];
      const double Z  = dynamics::damping_quotient(trial.frequency[a], trial.damping[a], wb, trial.damping[b]);
      if (k.size())
        C(a, b) += Z * k(a, b);
      if (m.size())
        C(a, b) += m(a, b) * (2 * trial.damping[b] * wb - Z * wb * wb);
    }
}

/// What unknown `name` adds to the dynamic stiffness in the modes.  theory.md (44.3)
void add_change(StandAt &trial, const dynamics::SlopedStand &slopes, const std::string &name)
{
  const Eigen::Index n = trial.frequency.size();
  Eigen::MatrixXd K, C, M;
  for (std::size_t s = 0; s < slopes.names.size(); ++s)
    if (moves(name, slopes.names[s]))
      add_parts(trial, slopes, s, K, C, M);
  const auto [what, mode] = moved_by(name);
  if (what == Moves::ratios || what == Moves::ratio || what == Moves::frequency) {
    K = C = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      if (i == mode || what == Moves::ratios)
        C(i, i) = 2 * trial.damping[i] * trial.frequency[i];
    if (what == Moves::frequency)
      K(mode, mode) = 2 * trial.frequency[mode] * trial.frequency[mode];
  }
  trial.stiffness.push_back(K);
  trial.damper.push_back(C);
  trial.mass.push_back(M);
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

bool is_mass(const FittedStand &stand, const std::string &name)
{
  if (stand.detailed)
    return mass_of(*stand.detailed, name) != nullptr;
  for (Eigen::Index i = 0; i < stand.chain.M.size(); ++i)
    if (name == mass_name(i))
      return true;
  return false;
}

std::vector<std::string> members_of(const std::string &unknown)
{
  std::vector<std::string> members;
  std::size_t from = 0;
  for (std::size_t bar; (bar = unknown.find('/', from)) != std::string::npos; from = bar + 1)
    members.push_back(unknown.substr(from, bar - from));
  members.push_back(unknown.substr(from));
  return members;
}

bool moves_springs(const FittedStand &stand, const std::string &unknown)
{
  if (is_spring(stand, unknown))
    return true;
  const auto members = members_of(unknown);
  return std::all_of(members.begin(), members.end(),
                     [&](const std::string &name) { return is_spring(stand, name); });
}

Eigen::VectorXcd StandAt::change(const std::size_t p, const Eigen::VectorXcd &x, const double w) const
{
  Eigen::VectorXcd changed = stiffness[p] * x + std::complex<double>(0, w) * (damper[p] * x);
  if (mass[p].size())
    changed -= w * w * (mass[p] * x);
  return changed;
}

bool share_a_part(const FittedStand &stand, const std::string &a, const std::string &b)
{
  if (!is_spring(stand, a) || !is_spring(stand, b))
    return false;
  std::set<int> parts;
  for (const std::string &name : {a, b}) {
    std::set<int> moved;
    if (stand.detailed)
      moved = spring_of(*stand.detailed, name)->parts;
    else
      for (const int mass : {spring_of(stand.chain, name)->from, spring_of(stand.chain, name)->to})
        if (mass != dynamics::ground)
          moved.insert(mass);
    for (const int part : moved)
      if (!parts.insert(part).second)
        return true;
  }
  return false;
}

StandAt stand_at(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta)
{
  require(theta.size() == Eigen::Index(unknowns.size()), "one theta for each unknown");
  const Eigen::Index n = stand.damping.size();
  bool parts = false, frequencies = false;
  for (const Unknown &unknown : unknowns) {
    const auto [what, mode] = moved_by(unknown.name);
    const bool part         = what == Moves::parts;
    frequencies             = frequencies || what == Moves::frequency;
    parts                   = parts || part;
    if (part ? !is_part(stand, unknown.name) : mode >= n)
      throw InputError("\"" + unknown.name + "\": this stand has no spring, mass or damping ratio of this name");
  }
  require(!parts || !frequencies, "springs and frequencies of modes are not fitted together");
  StandAt trial;
  const dynamics::SlopedStand slopes = slopes_at(stand, unknowns, theta);
  trial.frequency                    = slopes.frequency;
  trial.damping                      = slopes.damping;
  trial.force                        = slopes.force;
  trial.shape                        = slopes.shape;
  apply_modal(trial, unknowns, theta);
  for (const Unknown &unknown : unknowns)
    add_change(trial, slopes, unknown.name);
  return trial;
}
Eigen::MatrixXd frequency_slopes(const StandAt &trial)
{
  const Eigen::Index n  = trial.frequency.size();
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n, Eigen::Index(trial.stiffness.size()));
  for (std::size_t p = 0; p < trial.stiffness.size(); ++p)
    for (Eigen::Index i = 0; i < n; ++i) {
      const double square = trial.frequency[i] * trial.frequency[i];
      if (trial.stiffness[p].size())
        slope(i, Eigen::Index(p)) += 0.5 * trial.stiffness[p](i, i) / square;
      if (trial.mass[p].size())
        slope(i, Eigen::Index(p)) -= 0.5 * trial.mass[p](i, i);
    }
  return slope;
}
}  // namespace mill::twin
