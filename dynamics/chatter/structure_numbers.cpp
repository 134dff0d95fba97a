#include "dynamics/chatter/sensitivity.h"
#include "dynamics/response/modes.h"
#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>

// The numbers of a stand's structure and how its matrices move with them.  theory.md 27.3
namespace mill::dynamics {
namespace {
Eigen::MatrixXd one_at(const Eigen::Index n, const Eigen::Index i, const double value)
{
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
  m(i, i)           = value;
  return m;
}
}  // namespace

std::vector<StructureNumber> six_mass_numbers(const std::array<double, 6> &mass,
                                              const std::array<double, 6> &stiffness,
                                              const std::array<double, 6> &damping)
{
  using Six = std::array<double, 6>;
  const std::string bodies[6]{"upper housing",   "upper backup roll", "upper work roll",
                              "lower work roll", "lower backup roll", "lower housing"};
  const std::string springs[6]{"ground to upper housing",        "upper housing to backup roll",
                               "upper backup roll to work roll", "lower work roll to backup roll",
                               "lower backup roll to housing",   "lower housing to ground"};
  const std::string dampers[6]{"upper housing to backup roll",   "upper housing to work roll",
                               "upper backup roll to work roll", "lower work roll to backup roll",
                               "lower work roll to housing",     "lower backup roll to housing"};
  const auto only = [](const Six &all, const int i) {
    Six one{};
    one[i] = all[i];
    return one;
  };
  const auto scaled = [](Six all, const int i, const double factor) {
    all[i] *= factor;
    return all;
  };
  std::vector<StructureNumber> numbers;
  for (int i = 0; i < 6; ++i) {
    StructureNumber n;
    n.kind   = NumberKind::mass;
    n.key    = fmt::format("stand.masses[{}]", i);
    n.name   = "mass, " + bodies[i];
    n.unit   = "kg";
    n.value  = mass[i];
    n.M_by   = one_at(6, i, mass[i]);
    n.scaled = [=](const double f) { return six_mass_structure(scaled(mass, i, f), stiffness, damping); };
    numbers.push_back(n);
  }
  for (int i = 0; i < 6; ++i) {
    if (stiffness[i] == 0)
      continue;
    StructureNumber n;
    n.kind   = NumberKind::spring;
    n.key    = fmt::format("stand.stiffnesses[{}]", i);
    n.name   = "stiffness, " + springs[i];
    n.unit   = "N/m";
    n.value  = stiffness[i];
    n.K_by   = six_mass_structure(mass, only(stiffness, i), damping).K;
    n.scaled = [=](const double f) { return six_mass_structure(mass, scaled(stiffness, i, f), damping); };
    numbers.push_back(n);
  }
  for (int i = 0; i < 6; ++i) {
    if (damping[i] == 0)
      continue;
    StructureNumber n;
    n.kind   = NumberKind::damper;
    n.key    = fmt::format("stand.dampings[{}]", i);
    n.name   = "damping, " + dampers[i];
    n.unit   = "N s/m";
    n.value  = damping[i];
    n.C_by   = six_mass_structure(mass, stiffness, only(damping, i)).C;
    n.scaled = [=](const double f) { return six_mass_structure(mass, stiffness, scaled(damping, i, f)); };
    numbers.push_back(n);
  }
  StructureNumber all;
  all.kind   = NumberKind::all_dampers;
  all.key    = "stand.dampings";
  all.name   = "all dampings of the stand";
  all.unit   = "1";
  all.value  = 1;
  all.C_by   = six_mass_structure(mass, stiffness, damping).C;
  all.scaled = [=](const double f) {
    Six some = damping;
    for (double &c : some)
      c *= f;
    return six_mass_structure(mass, stiffness, some);
  };
  if (all.C_by.cwiseAbs().maxCoeff() > 0)
    numbers.push_back(all);
  return numbers;
}

namespace {
/// C = 2 zeta M^1/2 sqrt(M^-1/2 K M^-1/2) M^1/2, the modal damping of mill_model without modes in between, and its
/// derivatives, (27.8).
struct ModalDamping {
  Eigen::VectorXd root;  ///< (n) sqrt of the masses
  Eigen::MatrixXd S, R;  ///< (n, n) 1/s^2, 1/s
  Eigen::VectorXd w;     ///< (n) 1/s
  Eigen::MatrixXd U;     ///< (n, n) modes of S
  double ratio;          ///< -

  ModalDamping(const MillModel &model, const double zeta) : root(model.M.cwiseSqrt()), ratio(zeta)
  {
    S = root.cwiseInverse().asDiagonal() * model.K * root.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(S);
    w = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
    U = solver.eigenvectors();
    R = U * w.asDiagonal() * U.transpose();
  }
  /// dR from dS: R dR + dR R = dS, solved in the modes.
  Eigen::MatrixXd of_root(const Eigen::MatrixXd &S_by) const
  {
    Eigen::MatrixXd d = U.transpose() * S_by * U;
    for (Eigen::Index i = 0; i < w.size(); ++i)
      for (Eigen::Index j = 0; j < w.size(); ++j)
        d(i, j) = w[i] + w[j] > 0 ? d(i, j) / (w[i] + w[j]) : 0;
    return U * d * U.transpose();
  }
  Eigen::MatrixXd by_stiffness(const Eigen::MatrixXd &K_by) const
  {
    const auto inverse = root.cwiseInverse().asDiagonal();
    return 2 * ratio * (root.asDiagonal() * of_root(inverse * K_by * inverse) * root.asDiagonal());
  }
  Eigen::MatrixXd by_mass(const Eigen::Index i) const
  {
    const Eigen::MatrixXd half = one_at(root.size(), i, 0.5);  // d ln(M^1/2)/d ln m
    const Eigen::MatrixXd d    = half * R + R * half + of_root(-half * S - S * half);
    return 2 * ratio * (root.asDiagonal() * d * root.asDiagonal());
  }
};
}  // namespace

namespace {
Eigen::MatrixXd spring_between(const Eigen::Index n, const Spring &spring, const double stiffness)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (const int end : {spring.from, spring.to})
    if (end != ground)
      K(end, end) += stiffness;
  if (spring.from != ground && spring.to != ground)
    K(spring.from, spring.to) = K(spring.to, spring.from) = -stiffness;
  return K;
}
}  // namespace

std::vector<StructureNumber> chain_numbers(const LumpedModel &model, const DynamicsSettings &settings)
{
  const MillModel chain = mill_model(model, settings);
  const ModalDamping damping(chain, settings.modal_damping);
  const Eigen::Index n = chain.M.size();
  std::vector<StructureNumber> numbers;
  for (int i = 0; i < 6; ++i) {
    StructureNumber m;
    m.kind   = NumberKind::mass;
    m.key    = fmt::format("M{}", i + 1);
    m.name   = "mass, " + chain.labels[std::size_t(i)];
    m.unit   = "kg";
    m.value  = chain.M[i];
    m.M_by   = one_at(n, i, chain.M[i]);
    m.C_by   = damping.by_mass(i);
    m.scaled = [=](const double f) {
      LumpedModel other = model;
      other.M[std::size_t(i)].value *= f;
      other.moving_mass[std::size_t(i)] *= f;  // NaN stays: those at rest
      return structure_of(mill_model(other, settings));
    };
    numbers.push_back(m);
  }
  for (int i = 0; i < int(chain.springs.size()); ++i) {
    const Spring &spring = chain.springs[std::size_t(i)];
    if (spring.stiffness == 0)
      continue;
    StructureNumber k;
    k.kind  = NumberKind::spring;
    k.key   = spring.name;
    k.name  = "stiffness " + spring.name;
    k.unit  = "N/m";
    k.value = model.K[std::size_t(i)].value;
    // (27.15): of a spring without an oil film its stiffness itself.
    const double damped = 2 * M_PI * (std::isnan(model.film_frequency) ? 0 : model.film_frequency) * spring.damper;
    k.K_by = spring_between(n, spring, (spring.stiffness * spring.stiffness - damped * damped) / k.value);
    k.C_by =
        damping.by_stiffness(k.K_by) + spring_between(n, spring, 2 * spring.stiffness * spring.damper / k.value);
    k.scaled = [=](const double f) {
      LumpedModel other = model;
      other.K[std::size_t(i)].value *= f;
      return structure_of(mill_model(other, settings));
    };
    numbers.push_back(k);
  }
  if (settings.modal_damping > 0) {
    StructureNumber z;
    z.kind   = NumberKind::damping_ratio;
    z.key    = "dynamics.modal_damping";
    z.name   = "modal damping";
    z.unit   = "1";
    z.value  = settings.modal_damping;
    z.C_by   = damping.by_stiffness(2 * chain.K);  // sqrt is of degree one half
    z.scaled = [=](const double f) {
      DynamicsSettings other = settings;
      other.modal_damping *= f;
      return structure_of(mill_model(model, other));
    };
    numbers.push_back(z);
  }
  return numbers;
}

std::vector<StructureNumber> modal_numbers(const ModalModel &modes)
{
  const StandStructure stand = structure_of(modes);
  std::vector<StructureNumber> numbers;
  for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
    if (modes.frequency[i] == 0)
      continue;
    StructureNumber f;
    f.kind   = NumberKind::frequency;
    f.key    = fmt::format("stand.modes[{}]", i);
    f.name   = fmt::format("frequency of mode {}", i + 1);
    f.unit   = "Hz";
    f.value  = modes.frequency[i];
    f.K_by   = one_at(stand.n(), i, 2 * stand.K(i, i));
    f.C_by   = one_at(stand.n(), i, 4 * M_PI * modes.damping * modes.frequency[i]);
    f.scaled = [=](const double factor) {
      ModalModel other = modes;
      other.frequency[i] *= factor;
      return structure_of(other);
    };
    numbers.push_back(f);
  }
  if (modes.damping > 0) {
    StructureNumber z;
    z.kind   = NumberKind::damping_ratio;
    z.key    = "dynamics.modal_damping";
    z.name   = "modal damping";
    z.unit   = "1";
    z.value  = modes.damping;
    z.C_by   = (4 * M_PI * modes.damping * modes.frequency).asDiagonal();
    z.scaled = [=](const double factor) {
      ModalModel other = modes;
      other.damping *= factor;
      return structure_of(other);
    };
    numbers.push_back(z);
  }
  return numbers;
}
}  // namespace mill::dynamics
