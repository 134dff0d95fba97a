#include "dynamics/chatter/stand_structure.h"
#include "core/base/errors.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
/// Joins two bodies, or one to the ground, by a spring or a damper.
void join(Eigen::MatrixXd &matrix, const int from, const int to, const double value)
{
  if (from != ground)
    matrix(from, from) += value;
  if (to != ground)
    matrix(to, to) += value;
  if (from != ground && to != ground) {
    matrix(from, to) -= value;
    matrix(to, from) -= value;
  }
}

void require(const bool fine, const std::string &what, const double value, const char *unit, const char *limit)
{
  if (!fine)
    throw InputError(fmt::format("{} of the stand = {:g} {} has to be {}", what, value, unit, limit));
}
}  // namespace

StandStructure six_mass_structure(const std::array<double, 6> &mass, const std::array<double, 6> &stiffness,
                                  const std::array<double, 6> &damping)
{
  constexpr int springs[6][2] = {{ground, 0}, {0, 1}, {1, 2}, {3, 4}, {4, 5}, {5, ground}};
  constexpr int dampers[6][2] = {{0, 1}, {0, 2}, {1, 2}, {3, 4}, {3, 5}, {4, 5}};
  constexpr int names[6]      = {0, 1, 2, 4, 5, 6};  // a k3 would be the strip
  StandStructure s;
  s.name   = "six masses";
  s.labels = {"upper housing",   "upper backup roll", "upper work roll",
              "lower work roll", "lower backup roll", "lower housing"};
  s.M = s.C = s.K = Eigen::MatrixXd::Zero(6, 6);
  for (int i = 0; i < 6; ++i) {
    require(mass[i] > 0 && std::isfinite(mass[i]), fmt::format("mass m{}", i), mass[i], "kg", "above zero");
    require(stiffness[i] >= 0 && std::isfinite(stiffness[i]), fmt::format("stiffness k{}", names[i]), stiffness[i],
            "N/m", "zero or above");
    require(damping[i] >= 0 && std::isfinite(damping[i]), fmt::format("damping c{}", i), damping[i], "N s/m",
            "zero or above");
    s.M(i, i) = mass[i];
    join(s.K, springs[i][0], springs[i][1], stiffness[i]);
    join(s.C, dampers[i][0], dampers[i][1], damping[i]);
  }
  s.b    = Eigen::VectorXd::Zero(6);
  s.b[2] = s.b[3] = 1;
  s.point         = Eigen::MatrixXd::Identity(6, 6);
  for (std::size_t side = 0; side < 2; ++side) {
    s.stack_mass[side] = Eigen::MatrixXd::Zero(6, 6);
    s.stack_mass[side].diagonal().segment(3 * Eigen::Index(side), 3) =
        s.M.diagonal().segment(3 * Eigen::Index(side), 3);
  }
  return s;
}

StandStructure structure_of(const MillModel &chain)
{
  const Eigen::Index n = chain.M.size();
  StandStructure s;
  s.name   = "six masses";
  s.M      = chain.M.asDiagonal();
  s.C      = chain.C;
  s.K      = chain.K;
  s.b      = chain.b;
  s.labels = chain.labels;
  s.point  = Eigen::MatrixXd::Identity(n, n);
  s.point.bottomRows(n - n / 2) *= -1;  // the lower half moves down when it moves away
  Eigen::VectorXd upper = chain.M;
  upper.tail(n - n / 2) = Eigen::VectorXd::Zero(n - n / 2);
  s.stack_mass          = {upper.asDiagonal(), Eigen::VectorXd(chain.M - upper).asDiagonal()};
  return s;
}

StandStructure structure_of(const ModalModel &modes)
{
  const Eigen::VectorXd w = 2 * M_PI * modes.frequency;
  StandStructure s;
  s.name = "modes";
  s.M    = Eigen::MatrixXd::Identity(w.size(), w.size());
  s.C    = (2 * modes.damping * w).asDiagonal();
  if (modes.dampers.size() > 0)
    s.C += modes.dampers;
  s.K = w.cwiseAbs2().asDiagonal();
  s.b = modes.force;
  s.labels.assign(modes.labels.begin(), modes.labels.begin() + 6);
  s.point = modes.point.topRows(6);
  s.point.bottomRows(3) *= -1;
  s.stack_mass = modes.stack_mass;
  return s;
}
}  // namespace mill::dynamics
