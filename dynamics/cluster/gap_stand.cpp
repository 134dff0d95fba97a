#include "dynamics/cluster/gap_stand.h"
#include "core/numerics/eigen_instances.h"
#include "dynamics/cluster/modes.h"
#include <Eigen/Eigenvalues>
#include <cmath>

namespace mill::cluster {
GapStand gap_stand(const Stack &whole, const Motion &rest, const int upper, const int lower)
{
  Stack stack = whole;
  for (Contact &c : stack.contacts)
    if (c.strip)
      c.free_length = 0;  // no spring: the bite is what is added
  const bool turns    = stack.coupled && rest.size() != stack.size();
  const Tangent K     = tangent(stack, turns ? with_rotation(rest) : rest);
  const double halves = lower < 0 ? 2 : 1;  // (38.27)
  GapStand s;
  s.M    = halves * masses(stack);
  s.K    = halves * K.total;
  s.loss = Eigen::MatrixXd::Zero(stack.size(), stack.size());
  for (std::size_t i = 0; i < K.contacts.size(); ++i) {
    s.contacts.push_back(halves * K.contacts[i]);
    s.contact_losses.push_back(stack.contacts[i].loss_factor * halves * (K.contacts[i] - K.geometric[i]));
    s.loss += s.contact_losses.back();
  }
  for (std::size_t i = 0; i < K.supports.size(); ++i) {
    s.supports.push_back(halves * K.supports[i]);
    s.support_losses.push_back(stack.supports[i].loss_factor * s.supports.back());
    s.loss += s.support_losses.back();
  }
  s.b                               = Eigen::VectorXd::Zero(stack.size());
  s.b[stack.per_roll() * upper + 1] = halves;
  if (lower >= 0)
    s.b[stack.per_roll() * lower + 1] = -1;
  return s;
}

GapStand scaled(GapStand stand, const std::vector<std::size_t> &contacts, const std::vector<std::size_t> &supports,
                const double factor)
{
  const auto scale = [&](Eigen::MatrixXd &sum, std::vector<Eigen::MatrixXd> &parts,
                         const std::vector<std::size_t> &which) {
    for (const std::size_t i : which) {
      sum += (factor - 1) * parts[i];
      parts[i] *= factor;
    }
  };
  scale(stand.K, stand.contacts, contacts);
  scale(stand.K, stand.supports, supports);
  scale(stand.loss, stand.contact_losses, contacts);
  scale(stand.loss, stand.support_losses, supports);
  return stand;
}

GapStandModes modes_of(const GapStand &stand, const double K4)
{
  const Eigen::VectorXd w      = stand.M.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = w.asDiagonal() * (stand.K + K4 * stand.b * stand.b.transpose()) * w.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  GapStandModes m;
  m.frequency = eigen.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  m.shape     = w.asDiagonal() * eigen.eigenvectors();
  m.damping   = Eigen::VectorXd::Zero(m.frequency.size());
  for (Eigen::Index k = 0; k < m.damping.size(); ++k)
    if (eigen.eigenvalues()[k] > 0)
      m.damping[k] = 0.5 * m.shape.col(k).dot(stand.loss * m.shape.col(k)) / eigen.eigenvalues()[k];
  return m;
}

StripMotion strip_motion(const Stack &stack, const std::vector<double> &loads, const int roll, const double away,
                         const Eigen::VectorXd &shape)
{
  const auto up = [&](const int r) { return away * shape[stack.per_roll() * r + 1]; };
  StripMotion motion{up(roll), 0};
  double sum = 0;
  for (std::size_t i = 0; i < stack.contacts.size(); ++i) {
    const Contact &c = stack.contacts[i];
    if (c.strip || (c.a != roll && c.b != roll))
      continue;
    const Eigen::Vector2d along = stack.rolls[std::size_t(c.b)].centre - stack.rolls[std::size_t(c.a)].centre;
    const double vertical       = loads[i] * std::abs(along.normalized().y());
    motion.carrier += vertical * up(c.a == roll ? c.b : c.a);
    sum += vertical;
  }
  motion.carrier = sum > 0 ? motion.carrier / sum : 0;
  return motion;
}
}  // namespace mill::cluster
