#include "twin/calibration/likelihood.h"
#include "core/base/require.h"
#include "core/process/parallel.h"
#include "twin/calibration/elimination.h"
#include "twin/calibration/modal_columns.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
using Complex                    = std::complex<double>;
constexpr Eigen::Index at_a_time = 256;  // bins of one block: its arrays stay in the cache

/// Real rows (2 k, columns) of one sensor over the root of the noise: transients, derivatives, then what is left
/// of the measured.
Eigen::MatrixXd weighted_rows(const ModalColumns &c, const StandAt &trial, const BandRecord &band,
                              const Block &block, const Eigen::MatrixXd &noise, const Eigen::Index place,
                              const Eigen::Index sensor)
{
  const Eigen::Index n = trial.frequency.size(), p = Eigen::Index(c.derivative.size()), k = block.size;
  const Eigen::VectorXd seen  = trial.shape.row(place).transpose();
  const auto w                = band.angular.segment(block.first, k).array();
  const Eigen::ArrayXd weight = noise.col(sensor).segment(block.first, k).array().rsqrt();
  Eigen::MatrixXd rows(2 * k, 2 * n + p + 1);
  const auto put = [&](const Eigen::Index column, const auto &value) {
    rows.col(column).head(k) = (value.real() * weight).matrix();
    rows.col(column).tail(k) = (value.imag() * weight).matrix();
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::ArrayXcd one = seen[i] * c.admittance.col(i);
    put(2 * i, one);
    const double scale          = 1 / trial.frequency[i];
    rows.col(2 * i + 1).head(k) = (-scale * one.imag() * w * weight).matrix();
    rows.col(2 * i + 1).tail(k) = (scale * one.real() * w * weight).matrix();
  }
  for (Eigen::Index q = 0; q < p; ++q)
    put(2 * n + q, Eigen::ArrayXcd(c.derivative[std::size_t(q)].matrix() * seen));
  put(2 * n + p, Eigen::ArrayXcd(band.acceleration.col(sensor).segment(block.first, k).array() -
                                 (c.driven.matrix() * seen).array()));
  return rows;
}

std::vector<Block> blocks_of(const MeasuredResponse &data, const std::size_t piece)
{
  std::vector<Block> blocks;
  const Eigen::Index k = data.pieces[piece].angular.size();
  for (Eigen::Index first = 0; first < k; first += at_a_time)
    blocks.push_back({first, std::min(at_a_time, k - first)});
  return blocks;
}

/// Products of all columns of weighted_rows with each other, summed over sensors and bins of one piece.
Eigen::MatrixXd products(const StandAt &trial, const std::vector<Unknown> *unknowns, const MeasuredResponse &data,
                         const Eigen::MatrixXd &noise, const std::size_t piece, const Eigen::VectorXd &transient,
                         const int threads)
{
  const auto blocks       = blocks_of(data, piece);
  const Eigen::Index size = 2 * trial.frequency.size() + (unknowns ? Eigen::Index(unknowns->size()) : 0) + 1;
  constexpr std::size_t in_a_task = 8;
  const std::size_t tasks         = (blocks.size() + in_a_task - 1) / in_a_task;
  std::vector<Eigen::MatrixXd> sums(tasks, Eigen::MatrixXd::Zero(size, size));
  const BandRecord &band = data.pieces[piece];
  share_tasks(long(tasks), threads, [&](const long t) {
    for (std::size_t b = std::size_t(t) * in_a_task; b < std::min(blocks.size(), std::size_t(t + 1) * in_a_task);
         ++b) {
      ModalColumns c = modal_columns(trial, band, blocks[b]);
      if (unknowns)
        add_derivatives(c, trial, *unknowns, band, blocks[b], transient);
      for (std::size_t j = 0; j < data.places.size(); ++j) {
        const Eigen::MatrixXd rows =
            weighted_rows(c, trial, band, blocks[b], noise, data.places[j], Eigen::Index(j));
        sums[std::size_t(t)].selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
      }
    }
  });
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (const Eigen::MatrixXd &part : sums)
    sum += part;
  return sum.selfadjointView<Eigen::Lower>();
}
}  // namespace

void add_prior(Likelihood &sum, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta)
{
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const Unknown &unknown = unknowns[std::size_t(i)];
    const double away      = (theta[i] - unknown.prior) / unknown.prior_sd;
    sum.cost += 0.5 * away * away;
    if (sum.slope.size())
      sum.slope[i] += away / unknown.prior_sd;
  }
}

Likelihood likelihood(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta,
                      const MeasuredResponse &data, const NoiseDensity &noise, const Wanted wanted,
                      const int threads)
{
  require(noise.size() == data.pieces.size(), "one noise for each piece");
  const StandAt trial  = stand_at(stand, unknowns, theta);
  const Eigen::Index t = 2 * trial.frequency.size(), p = theta.size();
  Likelihood result;
  result.transient = Eigen::MatrixXd::Zero(t, Eigen::Index(data.pieces.size()));
  if (wanted != Wanted::cost) {
    result.slope       = Eigen::VectorXd::Zero(p);
    result.information = Eigen::MatrixXd::Zero(p, p);
  }
  for (std::size_t piece = 0; piece < data.pieces.size(); ++piece) {
    const Eigen::MatrixXd first = products(trial, nullptr, data, noise[piece], piece, {}, threads);
    const Elimination eliminated(first.topLeftCorner(t, t));
    const Eigen::VectorXd transient           = eliminated.solve(first.col(t).head(t));
    result.transient.col(Eigen::Index(piece)) = transient;
    result.residual += first(t, t) - first.col(t).head(t).dot(transient);
    if (wanted == Wanted::cost)
      continue;
    const Eigen::VectorXd followed =
        wanted == Wanted::slopes ? transient : Eigen::VectorXd::Zero(transient.size());
    const Eigen::MatrixXd all = products(trial, &unknowns, data, noise[piece], piece, followed, threads);
    const Elimination again(all.topLeftCorner(t, t));
    const Eigen::MatrixXd cross = all.block(0, t, t, p), out = again.solve(cross);
    result.slope -= 2 * (all.block(t, t + p, p, 1) - out.transpose() * all.block(0, t + p, t, 1));
    result.information += 2 * (all.block(t, t, p, p) - cross.transpose() * out);
  }
  result.cost = result.residual;
  add_prior(result, unknowns, theta);
  return result;
}

std::vector<Eigen::MatrixXcd> residuals(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                        const Eigen::VectorXd &theta, const MeasuredResponse &data,
                                        const NoiseDensity &noise)
{
  const StandAt trial     = stand_at(stand, unknowns, theta);
  const Likelihood fitted = likelihood(stand, unknowns, theta, data, noise, Wanted::cost);
  std::vector<Eigen::MatrixXcd> left;
  for (std::size_t piece = 0; piece < data.pieces.size(); ++piece) {
    const BandRecord &band = data.pieces[piece];
    const Block whole{0, band.angular.size()};
    const ModalColumns c   = modal_columns(trial, band, whole);
    Eigen::MatrixXcd modal = c.driven.matrix();
    for (Eigen::Index i = 0; i < trial.frequency.size(); ++i) {
      const double alpha = fitted.transient(2 * i, Eigen::Index(piece)),
                   beta  = fitted.transient(2 * i + 1, Eigen::Index(piece)) / trial.frequency[i];
      for (Eigen::Index b = 0; b < whole.size; ++b)
        modal(b, i) += Complex(alpha, beta * band.angular[b]) * c.admittance(b, i);
    }
    Eigen::MatrixXcd r = band.acceleration;
    for (std::size_t j = 0; j < data.places.size(); ++j)
      r.col(Eigen::Index(j)) -= modal * trial.shape.row(data.places[j]).transpose();
    left.push_back(std::move(r));
  }
  return left;
}

NoiseDensity noise_of(const std::vector<Eigen::MatrixXcd> &residuals)
{
  constexpr Eigen::Index reach = 200;
  NoiseDensity noise;
  for (const Eigen::MatrixXcd &r : residuals) {
    const Eigen::Index k = r.rows(), half = std::min(reach, std::max<Eigen::Index>(k / 8, 1));
    Eigen::MatrixXd mean(k, r.cols());
    for (Eigen::Index j = 0; j < r.cols(); ++j) {
      Eigen::VectorXd sum(k + 1);
      sum[0] = 0;
      for (Eigen::Index b = 0; b < k; ++b)
        sum[b + 1] = sum[b] + std::norm(r(b, j));
      // never zero: a sensor that the model explains to rounding would weigh infinitely
      const double least = 1e-20 * sum[k] / double(std::max<Eigen::Index>(k, 1)) + 1e-300;
      for (Eigen::Index b = 0; b < k; ++b) {
        const Eigen::Index from = std::max<Eigen::Index>(0, b - half), to = std::min(k, b + half + 1);
        mean(b, j) = std::max(least, (sum[to] - sum[from]) / double(to - from));
      }
    }
    noise.push_back(std::move(mean));
  }
  return noise;
}

NoiseDensity noise_before(const MeasuredResponse &data)
{
  std::vector<Eigen::MatrixXcd> all;
  for (const BandRecord &band : data.pieces)
    all.push_back(band.acceleration);
  return noise_of(all);
}
}  // namespace mill::twin
