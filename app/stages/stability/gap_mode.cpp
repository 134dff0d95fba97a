#include "app/stages/stability/gap_mode.h"
#include "reduce/stand/gap_modes.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

namespace mill {
namespace {
// The strip is the spring -F_1 between the work rolls; rolls move as they do at mid-length.
std::vector<reduce::GapMotion> rolling_modes(const dynamics::ChatterStandModel &stand,
                                             const bite::LinearCoefficients &bite)
{
  const dynamics::StandStructure &s = stand.structure;
  const Eigen::MatrixXd K           = s.K - bite.force[0] * s.b * s.b.transpose();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, s.M);
  const Eigen::VectorXd frequency = solver.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  const Eigen::VectorXd share     = reduce::gap_shares(frequency, solver.eigenvectors(), s.b);
  const Eigen::MatrixXd moves     = s.point * solver.eigenvectors();
  const auto displacement         = [&](const std::string &side, const char *roll, const Eigen::Index mode) {
    const auto place = std::find(s.labels.begin(), s.labels.end(), side + roll);
    return place == s.labels.end() ? 0. : moves(place - s.labels.begin(), mode);
  };
  std::vector<reduce::GapMotion> modes;
  for (Eigen::Index k = 0; k < frequency.size(); ++k) {
    reduce::GapMotion mode{frequency[k], share[k], {}, {}};
    const Eigen::VectorXd phi = solver.eigenvectors().col(k);
    for (const std::size_t i : {0, 1}) {
      const char *side  = i == 0 ? "upper" : "lower";
      const double work = displacement(side, " work roll", k), backup = displacement(side, " backup roll", k);
      const bool known = s.stack_mass[i].rows() == phi.size();
      mode.stacks.push_back(
          {side, known ? phi.dot(s.stack_mass[i] * phi) : work * work + backup * backup, work, backup});
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}
}  // namespace

double GapMode::damping() const
{
  return -root.real() / std::abs(root);
}

GapMode gap_mode(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite)
{
  const auto modes = rolling_modes(stand, bite);
  GapMode mode;
  for (const reduce::GapMotion &one : modes)
    if (reduce::gap_kind(one) == reduce::GapKind::first && one.gap_share > mode.share) {
      mode.share     = one.gap_share;
      mode.frequency = one.frequency;
    }
  if (mode.share == 0)
    return mode;
  const Eigen::VectorXcd roots = dynamics::eigenvalues(dynamics::chatter_matrix(stand, bite));
  double least                 = std::numeric_limits<double>::infinity();
  for (const std::complex<double> &root : roots)
    if (const double apart = std::abs(root.imag() / (2 * M_PI) - mode.frequency); apart < least) {
      least     = apart;
      mode.root = root;
    }
  return mode;
}

std::string text_of_root(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite,
                         const double frequency)
{
  if (!(frequency > 0))
    return "motion without vibration";
  const auto modes           = rolling_modes(stand, bite);
  const auto nearest         = std::min_element(modes.begin(), modes.end(), [&](const auto &a, const auto &b) {
    return std::abs(a.frequency - frequency) < std::abs(b.frequency - frequency);
  });
  const reduce::GapKind kind = reduce::gap_kind(*nearest);
  const char *name           = kind == reduce::GapKind::none    ? "mode"
                               : kind == reduce::GapKind::first ? "gap mode"
                                                                : "gap mode of the second kind";
  return fmt::format("{} at {:.0f} Hz{}", name, frequency, reduce::octave(frequency, kind));
}
}  // namespace mill
