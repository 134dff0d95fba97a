#include "dynamics/response/response_band.h"
#include "core/base/require.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

namespace mill::dynamics {
namespace {
constexpr double normal_95 = 1.959963984540054;  // standard deviations that hold 95 % of a normal distribution

/// Factor by which an input of this error is off in one sample.
class Draw {
public:
  explicit Draw(const unsigned seed) : random(seed) {}
  double operator()(const double error)
  {
    return std::exp(error / normal_95 * normal(random));
  }

private:
  std::mt19937_64 random;
  std::normal_distribution<double> normal;
};

/// One stand drawn from the errors, in the first n modes of the nominal one.
ModalResponse drawn(const ModalResponse &low, const std::vector<UncertainInput> &inputs,
                    const Eigen::VectorXd &mode_error, const double damping_error, Draw &draw)
{
  const Eigen::Index n = low.frequency.size();
  Eigen::VectorXd rad  = 2 * M_PI * low.frequency;
  for (Eigen::Index i = 0; i < n; ++i)
    rad[i] *= draw(mode_error[i]);
  Eigen::MatrixXd K = rad.cwiseAbs2().asDiagonal(), M = Eigen::MatrixXd::Identity(n, n);
  for (const UncertainInput &input : inputs) {  // (32.6)
    const double change = draw(input.error) - 1;
    K += change * input.dK;
    M += change * input.dM;
  }
  const double damping = low.damping * draw(damping_error);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);  // (32.7)
  const Eigen::MatrixXd &V = solver.eigenvectors();
  return {solver.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI),
          low.seen * V,
          low.pushed * V,
          V.transpose() * low.gap,
          damping,
          low.gap_damper,
          low.dampers.rows() > 0 ? Eigen::MatrixXd(low.dampers * V) : Eigen::MatrixXd()};
}

/// Response of the first force alone, which the band is made for.
ModalResponse of_first_force(const ModalResponse &all)
{
  ModalResponse one = all;
  one.pushed        = all.pushed.topRows(1);
  return one;
}

/// (m, k): largest magnitude at the modes between two frequencies; 0 without one.
Eigen::MatrixXd largest_at_modes(const ModalResponse &stand, const double from, const double to)
{
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(stand.seen.rows(), stand.pushed.rows());
  for (const double f : stand.frequency)
    if (f >= from && f <= to)
      largest = largest.cwiseMax(accelerance(stand, f).cwiseAbs());
  return largest;
}

/// Magnitudes of all samples.
struct Samples {
  std::vector<Eigen::MatrixXd> amplitude;  ///< (f) of (samples, m)
  Eigen::MatrixXd peak;                    ///< (samples, m k)
};

/// Ends of the middle 95 % of a sample.  (32.8)
std::pair<double, double> ends_of(Eigen::VectorXd values)
{
  std::sort(values.begin(), values.end());
  const auto tail = Eigen::Index(std::floor(0.025 * double(values.size())));
  return {values[tail], values[values.size() - 1 - tail]};
}
}  // namespace

ResponseBand response_band(const ModalResponse &all, const Eigen::Index n,
                           const std::vector<UncertainInput> &inputs, const Eigen::VectorXd &mode_error,
                           const Eigen::VectorXd &frequency, const BandSettings &settings)
{
  require(all.pushed.rows() > 0 && mode_error.size() == n, "a band needs a force and an error for each mode");
  const ModalResponse low = first_modes(all, n);
  const Eigen::Index n_f = frequency.size(), m = all.seen.rows(), k = all.pushed.rows();
  Eigen::MatrixXcd rest(n_f, m);  // of the modes left out
  for (Eigen::Index i = 0; i < n_f; ++i)
    rest.row(i) = (accelerance(of_first_force(all), frequency[i]) - accelerance(of_first_force(low), frequency[i]))
                      .transpose();
  Samples samples{std::vector<Eigen::MatrixXd>(std::size_t(n_f), Eigen::MatrixXd(settings.samples, m)),
                  Eigen::MatrixXd(settings.samples, m * k)};
  Draw draw(settings.seed);
  for (int s = 0; s < settings.samples; ++s) {
    const ModalResponse stand = drawn(low, inputs, mode_error, settings.damping_error, draw);
    const ModalResponse one   = of_first_force(stand);
    samples.peak.row(s)       = largest_at_modes(stand, frequency[0], frequency[n_f - 1]).reshaped().transpose();
    for (Eigen::Index i = 0; i < n_f; ++i)
      samples.amplitude[std::size_t(i)].row(s) =
          (accelerance(one, frequency[i]).transpose() + rest.row(i)).cwiseAbs();
  }
  ResponseBand band{Eigen::MatrixXd(n_f, m), Eigen::MatrixXd(n_f, m), Eigen::MatrixXd(m, k),
                    Eigen::MatrixXd(m, k)};
  for (Eigen::Index p = 0; p < m; ++p)
    for (Eigen::Index i = 0; i < n_f; ++i)
      std::tie(band.low(i, p), band.high(i, p)) = ends_of(samples.amplitude[std::size_t(i)].col(p));
  for (Eigen::Index j = 0; j < m * k; ++j)
    std::tie(band.peak_low(j % m, j / m), band.peak_high(j % m, j / m)) = ends_of(samples.peak.col(j));
  return band;
}
}  // namespace mill::dynamics
