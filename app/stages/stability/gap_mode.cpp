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
// The undamped modes with a spring between the work rolls, by what they do to the gap.
struct RollingModes {
  std::vector<reduce::GapMotion> motions;
  Eigen::MatrixXd shape;  // mass-normalised
};

// Rolls move as they do at mid-length.
RollingModes rolling_modes(const dynamics::StandStructure &s, const double spring)
{
  const Eigen::MatrixXd K = s.K + spring * s.b * s.b.transpose();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, s.M);
  RollingModes modes;
  modes.shape                     = solver.eigenvectors();
  const Eigen::VectorXd frequency = solver.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  const Eigen::VectorXd share     = reduce::gap_shares(frequency, modes.shape, s.b);
  const Eigen::MatrixXd moves     = s.point * modes.shape;
  const auto displacement         = [&](const std::string &side, const char *roll, const Eigen::Index mode) {
    const auto place = std::find(s.labels.begin(), s.labels.end(), side + roll);
    return place == s.labels.end() ? 0. : moves(place - s.labels.begin(), mode);
  };
  for (Eigen::Index k = 0; k < frequency.size(); ++k) {
    reduce::GapMotion mode{frequency[k], share[k], {}, {}};
    const Eigen::VectorXd phi = modes.shape.col(k);
    for (const std::size_t i : {0, 1}) {
      const char *side  = i == 0 ? "upper" : "lower";
      const double work = displacement(side, " work roll", k), backup = displacement(side, " backup roll", k);
      const bool known = s.stack_mass[i].rows() == phi.size();
      mode.stacks.push_back(
          {side, known ? phi.dot(s.stack_mass[i] * phi) : work * work + backup * backup, work, backup});
    }
    modes.motions.push_back(std::move(mode));
  }
  return modes;
}

// The spring that the linear bite is at constant friction, tensions and flattening.
double spring_of(const bite::LinearCoefficients &bite)
{
  return -bite.force[0];
}

// A root of stand, bite and strip with the motion of the stand in it.
struct Vibration {
  std::complex<double> root;
  Eigen::VectorXcd motion;
};

// All that vibrate, one of each pair.
std::vector<Vibration> vibrations(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite)
{
  const Eigen::MatrixXd A     = dynamics::chatter_matrix(stand, bite);
  const Eigen::VectorXd scale = dynamics::balance(A);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal());
  const Eigen::Index n = stand.structure.n();
  std::vector<Vibration> all;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (const std::complex<double> root = solver.eigenvalues()[i]; root.imag() > 0)
      all.push_back({root, (scale.asDiagonal() * solver.eigenvectors().col(i)).head(n)});
  return all;
}

// (modes) share of each undamped mode in a motion, modal assurance with M.
Eigen::VectorXd shares_in(const Eigen::VectorXcd &motion, const dynamics::StandStructure &s,
                          const Eigen::MatrixXd &shape)
{
  const Eigen::VectorXcd Mx = s.M * motion;
  return (shape.transpose() * Mx).cwiseAbs2() / std::abs(motion.dot(Mx));
}

Eigen::Index largest_share(const Eigen::VectorXcd &motion, const dynamics::StandStructure &s,
                           const Eigen::MatrixXd &shape)
{
  Eigen::Index largest = 0;
  shares_in(motion, s, shape).maxCoeff(&largest);
  return largest;
}

std::string text_of(const std::complex<double> root, const reduce::GapMotion &mode)
{
  const double frequency     = std::abs(root.imag()) / (2 * M_PI);
  const reduce::GapKind kind = reduce::gap_kind(mode);
  const char *name           = kind == reduce::GapKind::none    ? "mode"
                               : kind == reduce::GapKind::first ? "gap mode"
                                                                : "gap mode of the second kind";
  return fmt::format("{} at {:.0f} Hz{}", name, frequency, reduce::octave(frequency, kind));
}
}  // namespace

double GapMode::damping() const
{
  return -root.real() / std::abs(root);
}

GapMode gap_mode(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite, const double K4)
{
  const RollingModes modes = rolling_modes(stand.structure, std::isnan(K4) ? spring_of(bite) : K4);
  const int k              = reduce::gap_mode(modes.motions, reduce::GapKind::first);
  GapMode mode;
  if (k < 0)
    return mode;
  mode.share     = modes.motions[std::size_t(k)].gap_share;
  mode.frequency = modes.motions[std::size_t(k)].frequency;
  double largest = 0;
  for (const Vibration &vibration : vibrations(stand, bite))
    if (const double share = shares_in(vibration.motion, stand.structure, modes.shape)[k]; share > largest) {
      largest   = share;
      mode.root = vibration.root;
    }
  return mode;
}

std::string text_of_root(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite,
                         const std::complex<double> root)
{
  const auto all = vibrations(stand, bite);
  if (all.empty() || !(std::abs(root.imag()) > std::abs(root.real())))
    return "motion without vibration";
  const RollingModes modes   = rolling_modes(stand.structure, spring_of(bite));
  const Vibration &vibration = *std::min_element(all.begin(), all.end(), [&](const auto &one, const auto &other) {
    return std::abs(one.root - root) < std::abs(other.root - root);
  });
  return text_of(root, modes.motions[std::size_t(largest_share(vibration.motion, stand.structure, modes.shape))]);
}

LeastDamped least_damped(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite)
{
  const RollingModes modes = rolling_modes(stand.structure, spring_of(bite));
  LeastDamped least;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Vibration &vibration : vibrations(stand, bite)) {
    const reduce::GapMotion &mode =
        modes.motions[std::size_t(largest_share(vibration.motion, stand.structure, modes.shape))];
    const double damping = -vibration.root.real() / std::abs(vibration.root);
    if (mode.gap_share < reduce::least_share_listed || damping >= smallest)
      continue;
    smallest       = damping;
    least.root     = vibration.root;
    least.sentence = text_of(vibration.root, mode);
  }
  return least;
}
}  // namespace mill
