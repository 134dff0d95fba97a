#include "app/stages/stability/gap_mode.h"
#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double least_share = 0.01;  // of the compliance of the gap
constexpr double first_kind  = 450;   // Hz, above it the work rolls move against their backup rolls
constexpr double third_octave[2]{110, 280}, fifth_octave[2]{450, 900};  // Hz

struct RollingModes {
  Eigen::VectorXd frequency;  // Hz
  Eigen::VectorXd share;      // of the compliance of the gap
};

// The strip is the spring -F_1 between the work rolls.
RollingModes rolling_modes(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite)
{
  const dynamics::StandStructure &s = stand.structure;
  const Eigen::MatrixXd K           = s.K - bite.force[0] * s.b * s.b.transpose();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, s.M);
  RollingModes modes;
  const Eigen::VectorXd w2 = solver.eigenvalues();
  modes.frequency          = w2.cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  modes.share = (solver.eigenvectors().transpose() * s.b).cwiseAbs2().cwiseQuotient(w2.cwiseMax(1e-30));
  modes.share /= modes.share.sum();
  return modes;
}

std::string octave_of(const double frequency)
{
  if (frequency >= third_octave[0] && frequency <= third_octave[1])
    return " (third octave)";
  return frequency >= fifth_octave[0] && frequency <= fifth_octave[1] ? " (fifth octave)" : "";
}
}  // namespace

double GapMode::damping() const
{
  return -root.real() / std::abs(root);
}

GapMode gap_mode(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite)
{
  const RollingModes modes = rolling_modes(stand, bite);
  GapMode mode;
  for (Eigen::Index i = 0; i < modes.frequency.size() && modes.frequency[i] < first_kind; ++i)
    if (modes.share[i] > mode.share) {
      mode.share     = modes.share[i];
      mode.frequency = modes.frequency[i];
    }
  const Eigen::VectorXcd roots = dynamics::eigenvalues(dynamics::chatter_matrix(stand, bite));
  double least                 = 1e300;
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
  const RollingModes modes = rolling_modes(stand, bite);
  Eigen::Index nearest     = 0;
  (modes.frequency.array() - frequency).abs().minCoeff(&nearest);
  const char *name = modes.share[nearest] >= least_share ? "gap mode" : "mode";
  return fmt::format("{} at {:.0f} Hz{}", name, frequency, octave_of(frequency));
}
}  // namespace mill
