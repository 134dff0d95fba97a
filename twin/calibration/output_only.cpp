#include "twin/calibration/output_only.h"
#include "core/base/require.h"
#include "core/process/parallel.h"
#include "twin/calibration/elimination.h"
#include "twin/calibration/modal_columns.h"
#include <algorithm>
#include <cmath>
#include <functional>

namespace mill::twin {
namespace {
using Complex                      = std::complex<double>;
constexpr Eigen::Index in_a_block  = 256;   // bins: its arrays stay in the cache
constexpr std::size_t in_one_task  = 8;     // blocks
constexpr double no_prior_of_force = 1e12;  // times what a density is: the force may be anything

/// The stand at theta as the sensors of one record see it.
struct SeenStand {
  const OutputOnly &record;
  StandAt modes;
  Eigen::MatrixXd sees;      // (n, m) shapes at the sensors
  Eigen::VectorXd at_knots;  // (q)
  SeenStand(const OutputOnly &r, const Eigen::VectorXd &theta) : record(r)
  {
    const auto p = Eigen::Index(r.unknowns.size());
    require(theta.size() == p + r.force.knots.size(), "theta of the stand, then of the force");
    modes    = stand_at(r.stand, r.unknowns, theta.head(p));
    at_knots = theta.tail(r.force.knots.size());
    sees.resize(modes.shape.cols(), Eigen::Index(r.data.places.size()));
    for (std::size_t j = 0; j < r.data.places.size(); ++j)
      sees.col(Eigen::Index(j)) = modes.shape.row(r.data.places[j]).transpose();
  }
};

/// One block of bins, everything over the root of the noise.
struct SeenBlock {
  ModalColumns modes;         // of one newton
  Eigen::ArrayXXd weight;     // (k, m)
  Eigen::ArrayXd root;        // (k) of the density of the force
  Eigen::ArrayXXcd u;         // (k, m) response to that density
  Eigen::ArrayXd size;        // (k) |u|^2
  Eigen::ArrayXd gain;        // (k) 1/(1 + |u|^2)
  Eigen::ArrayXXcd measured;  // (k, m)
};

Eigen::ArrayXXcd weighted(const Eigen::ArrayXXcd &modal, const Eigen::MatrixXd &sees,
                          const Eigen::ArrayXXd &weight)
{
  Eigen::ArrayXXcd seen = (modal.matrix() * sees).array();
  for (Eigen::Index j = 0; j < seen.cols(); ++j)
    seen.col(j) *= weight.col(j);
  return seen;
}

SeenBlock seen_block(const SeenStand &stand, const BandRecord &band, const Eigen::MatrixXd &noise,
                     const Block &block)
{
  SeenBlock b;
  b.modes  = modal_columns(stand.modes, band, block);
  b.weight = noise.middleRows(block.first, block.size).array().rsqrt();
  b.root   = Eigen::ArrayXd::NullaryExpr(block.size, [&](const Eigen::Index i) {
    return std::sqrt(density(stand.record.force, stand.at_knots, band.angular[block.first + i] / (2 * M_PI)));
  });
  b.u      = weighted(b.modes.driven, stand.sees, b.weight);
  b.u.colwise() *= b.root.cast<Complex>();
  b.size     = b.u.abs2().rowwise().sum();
  b.gain     = (1 + b.size).inverse();
  b.measured = band.acceleration.middleRows(block.first, block.size).array() * b.weight;
  return b;
}

/// conj(a) b summed over the sensors.
Eigen::ArrayXcd inner(const Eigen::ArrayXXcd &a, const Eigen::ArrayXXcd &b)
{
  return (a.conjugate() * b).rowwise().sum();
}

/// Adds sign Re(columns' columns).
void add_products(Eigen::MatrixXd &sum, const Eigen::MatrixXcd &columns, const double sign)
{
  Eigen::MatrixXd rows(2 * columns.rows(), columns.cols());
  rows << columns.real(), columns.imag();
  sum.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose(), sign);
}

/// Column of a transient of unit size: alpha_i, then beta_i counted in 1/w_i, as add_derivatives() counts it.
Eigen::MatrixXcd ringing_columns(const SeenStand &stand, const BandRecord &band, const Block &block,
                                 const SeenBlock &b, const Eigen::Index sensor)
{
  const Eigen::Index n = stand.modes.frequency.size();
  const auto w         = band.angular.segment(block.first, block.size).array();
  Eigen::MatrixXcd columns(block.size, 2 * n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    columns.col(2 * i)     = stand.sees(i, sensor) * b.modes.admittance.col(i) * b.weight.col(sensor);
    columns.col(2 * i + 1) = columns.col(2 * i).array() * (Complex(0, 1 / stand.modes.frequency[i]) * w);
  }
  columns.col(2 * n) = b.measured.col(sensor);
  return columns;
}

/// Blocks of one piece, shared out; the sums of the tasks are added in their order.
template <class Sum>
Sum over_blocks(const BandRecord &band, const int threads, const Sum &zero,
                const std::function<void(Sum &, const Block &)> &add)
{
  const Eigen::Index k = band.angular.size(), task = in_a_block * Eigen::Index(in_one_task);
  std::vector<Sum> sums(std::size_t((k + task - 1) / task), zero);
  share_tasks(long(sums.size()), threads, [&](const long t) {
    const Eigen::Index end = std::min(k, (t + 1) * task);
    for (Eigen::Index first = t * task; first < end; first += in_a_block)
      add(sums[std::size_t(t)], {first, std::min(in_a_block, end - first)});
  });
  Sum all = zero;
  for (const Sum &sum : sums)
    all += sum;
  return all;
}

/// Products of the ringing and, last, the measured in S^-1; then the sum of ln(1 + |u|^2).
struct RingingSums {
  Eigen::MatrixXd products;
  double logarithms = 0;
  RingingSums &operator+=(const RingingSums &other)
  {
    products += other.products;
    logarithms += other.logarithms;
    return *this;
  }
};

RingingSums ringing_sums(const SeenStand &stand, const BandRecord &band, const Eigen::MatrixXd &noise,
                         const int threads)
{
  const Eigen::Index columns = 2 * stand.modes.frequency.size() + 1;
  const RingingSums zero{Eigen::MatrixXd::Zero(columns, columns), 0};
  RingingSums sums = over_blocks<RingingSums>(band, threads, zero, [&](RingingSums &sum, const Block &block) {
    const SeenBlock b         = seen_block(stand, band, noise, block);
    Eigen::MatrixXcd along    = Eigen::MatrixXcd::Zero(block.size, columns);
    const Eigen::ArrayXd root = b.gain.sqrt();
    for (Eigen::Index j = 0; j < stand.sees.cols(); ++j) {
      const Eigen::MatrixXcd one = ringing_columns(stand, band, block, b, j);
      add_products(sum.products, one, 1);
      along += (b.u.col(j).conjugate() * root).matrix().asDiagonal() * one;
    }
    add_products(sum.products, along, -1);
    sum.logarithms += (1 + b.size).log().sum();
  });
  sums.products    = Eigen::MatrixXd(sums.products.selfadjointView<Eigen::Lower>());
  return sums;
}

struct Slopes {
  Eigen::VectorXd slope;
  Eigen::MatrixXd information;
  Eigen::MatrixXd with_force;  // empty: not asked for
  Slopes &operator+=(const Slopes &other)
  {
    slope += other.slope;
    information += other.information;
    with_force += other.with_force;
    return *this;
  }
};

/// Transients of one block as accelerations, and their slopes to theta: a stand that nothing drives.
struct Ringing {
  Eigen::ArrayXXcd value;               // (k, m)
  std::vector<Eigen::ArrayXXcd> slope;  // (p) (k, m)
};

Ringing ringing(const SeenStand &stand, const BandRecord &band, const Block &block, const SeenBlock &b,
                const Eigen::VectorXd &transient)
{
  ModalColumns c = b.modes;
  c.driven.setZero();
  c.derivative.clear();
  add_derivatives(c, stand.modes, stand.record.unknowns, band, block, transient);
  Ringing r{Eigen::ArrayXXcd::Zero(block.size, stand.sees.cols()), {}};
  for (Eigen::Index j = 0; j < stand.sees.cols(); ++j)
    r.value.col(j) = (ringing_columns(stand, band, block, b, j).leftCols(transient.size()) * transient).array();
  for (const Eigen::ArrayXXcd &modal : c.derivative)
    r.slope.push_back(weighted(modal, stand.sees, b.weight));
  return r;
}

/// Slopes and expected curvature of one block.  (44.12)
void add_slopes(Slopes &sum, const SeenStand &stand, const BandRecord &band, const Eigen::MatrixXd &noise,
                const Block &block, const Eigen::VectorXd &transient)
{
  SeenBlock b          = seen_block(stand, band, noise, block);
  const Ringing rung   = ringing(stand, band, block, b, transient);
  const Eigen::Index k = block.size, m = stand.sees.cols(), p = Eigen::Index(stand.record.unknowns.size());
  b.modes.derivative.clear();
  add_derivatives(b.modes, stand.modes, stand.record.unknowns, band, block,
                  Eigen::VectorXd::Zero(transient.size()));
  const Eigen::ArrayXXcd z    = b.measured - rung.value;
  const Eigen::ArrayXcd along = inner(b.u, z);          // rho
  const Eigen::ArrayXd energy = b.gain * along.abs2();  // g |rho|^2
  Eigen::MatrixXd level       = Eigen::MatrixXd::Zero(k, sum.slope.size()), across(2 * k * m, p);
  const bool asked            = sum.with_force.size() > 0;
  Eigen::MatrixXd all(asked ? 2 * k * m : 0, p);
  for (Eigen::Index q = 0; q < p; ++q) {
    Eigen::ArrayXXcd v = weighted(b.modes.derivative[std::size_t(q)], stand.sees, b.weight);
    v.colwise() *= b.root.cast<Complex>();
    const Eigen::ArrayXXcd &rings = rung.slope[std::size_t(q)];
    const Eigen::ArrayXcd alpha = inner(b.u, v), beta = inner(v, z);
    const Eigen::ArrayXcd moved = inner(rings, z) - b.gain * inner(rings, b.u) * along;
    sum.slope[q] +=
        (2 * b.gain * (alpha.real() * (1 + energy) - (along.conjugate() * beta).real()) - 2 * moved.real()).sum();
    level.col(q) = (2 * b.gain * alpha.real()).matrix();
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::ArrayXcd side =
          (v.col(j) - b.u.col(j) * alpha / b.size.max(1e-300)) * (2 * b.gain * b.size).sqrt().cast<Complex>();
      across.col(q).segment(2 * k * j, k)     = side.real().matrix();
      across.col(q).segment(2 * k * j + k, k) = side.imag().matrix();
      if (asked) {
        all.col(q).segment(2 * k * j, k)     = M_SQRT2 * v.col(j).real().matrix();
        all.col(q).segment(2 * k * j + k, k) = M_SQRT2 * v.col(j).imag().matrix();
      }
    }
  }
  for (Eigen::Index i = 0; i < k; ++i) {
    const BetweenKnots between = between_knots(stand.record.force, band.angular[block.first + i] / (2 * M_PI));
    const double seen = b.gain[i] * b.size[i], steep = seen * (1 + energy[i]) - energy[i];
    for (const auto &[knot, share] :
         {std::pair{between.below, 1 - between.share}, std::pair{between.below + 1, between.share}}) {
      level(i, p + knot) = share * seen;
      sum.slope[p + knot] += share * steep;
    }
  }
  sum.information.selfadjointView<Eigen::Lower>().rankUpdate(level.transpose());
  sum.information.topLeftCorner(p, p).selfadjointView<Eigen::Lower>().rankUpdate(across.transpose());
  if (asked)
    sum.with_force.selfadjointView<Eigen::Lower>().rankUpdate(all.transpose());
}

Slopes slopes_of(const SeenStand &stand, const BandRecord &band, const Eigen::MatrixXd &noise,
                 const Eigen::VectorXd &transient, const int threads, const bool as_if_recorded = false)
{
  const auto p = Eigen::Index(stand.record.unknowns.size()), q = p + stand.record.force.knots.size();
  const Eigen::Index asked = as_if_recorded ? p : 0;
  Slopes sums              = over_blocks<Slopes>(
      band, threads, {Eigen::VectorXd::Zero(q), Eigen::MatrixXd::Zero(q, q), Eigen::MatrixXd::Zero(asked, asked)},
      [&](Slopes &sum, const Block &block) { add_slopes(sum, stand, band, noise, block, transient); });
  sums.information = Eigen::MatrixXd(sums.information.selfadjointView<Eigen::Lower>());
  sums.with_force  = Eigen::MatrixXd(sums.with_force.selfadjointView<Eigen::Lower>());
  return sums;
}

/// Transients that leave least, and what the rest costs.
struct Rung {
  Eigen::VectorXd transient;
  double left;
};

Rung eliminated(const RingingSums &sums)
{
  const Eigen::Index t = sums.products.rows() - 1;
  const Eigen::VectorXd transient =
      Elimination(sums.products.topLeftCorner(t, t)).solve(sums.products.col(t).head(t));
  return {transient, sums.products(t, t) - sums.products.col(t).head(t).dot(transient)};
}
}  // namespace

std::vector<Unknown> OutputOnly::all_unknowns() const
{
  std::vector<Unknown> all = unknowns;
  for (const Unknown &knot : unknowns_of(force))
    all.push_back(knot);
  return all;
}

void set_unit_force(MeasuredResponse &data)
{
  for (BandRecord &band : data.pieces)
    band.force = Eigen::VectorXcd::Ones(band.angular.size());
}

Likelihood output_only_likelihood(const OutputOnly &record, const Eigen::VectorXd &theta,
                                  const NoiseDensity &noise, const Wanted wanted, const int threads)
{
  require(noise.size() == record.data.pieces.size(), "one noise for each piece");
  const SeenStand stand(record, theta);
  Likelihood result;
  result.transient =
      Eigen::MatrixXd::Zero(2 * stand.modes.frequency.size(), Eigen::Index(record.data.pieces.size()));
  if (wanted != Wanted::cost) {
    result.slope       = Eigen::VectorXd::Zero(theta.size());
    result.information = Eigen::MatrixXd::Zero(theta.size(), theta.size());
  }
  for (std::size_t piece = 0; piece < record.data.pieces.size(); ++piece) {
    const BandRecord &band                    = record.data.pieces[piece];
    const RingingSums sums                    = ringing_sums(stand, band, noise[piece], threads);
    const Rung rung                           = eliminated(sums);
    result.transient.col(Eigen::Index(piece)) = rung.transient;
    result.residual += rung.left;
    result.cost += rung.left + sums.logarithms;
    if (wanted == Wanted::cost)
      continue;
    const Slopes slopes = slopes_of(stand, band, noise[piece], rung.transient, threads);
    result.slope += slopes.slope;
    result.information += slopes.information;
  }
  add_prior(result, record.all_unknowns(), theta);
  return result;
}

std::vector<SeenForce> seen_force(const OutputOnly &record, const Eigen::VectorXd &theta,
                                  const NoiseDensity &noise)
{
  const SeenStand stand(record, theta);
  std::vector<SeenForce> all;
  for (std::size_t piece = 0; piece < record.data.pieces.size(); ++piece) {
    const BandRecord &band = record.data.pieces[piece];
    const Block whole{0, band.angular.size()};
    const Rung rung    = eliminated(ringing_sums(stand, band, noise[piece], 1));
    const SeenBlock b  = seen_block(stand, band, noise[piece], whole);
    Eigen::ArrayXXcd z = b.measured;
    for (Eigen::Index j = 0; j < z.cols(); ++j)
      z.col(j) -=
          (ringing_columns(stand, band, whole, b, j).leftCols(rung.transient.size()) * rung.transient).array();
    SeenForce seen;
    seen.density  = b.root.square().matrix();
    seen.force    = (b.root * b.gain * inner(b.u, z)).matrix();
    seen.variance = (b.root.square() * b.gain).matrix();
    seen.response = b.modes.driven.matrix() * stand.sees;
    seen.left     = (z / b.weight).matrix() - seen.force.asDiagonal() * seen.response;
    all.push_back(std::move(seen));
  }
  return all;
}

NoiseDensity renewed_noise(const OutputOnly &record, const Eigen::VectorXd &theta, NoiseDensity noise)
{
  for (int round = 0; round < 8; ++round) {
    std::vector<Eigen::MatrixXcd> expected;  // its square is what noise_of() averages
    for (const SeenForce &seen : seen_force(record, theta, noise)) {
      const Eigen::MatrixXd unsure = seen.variance.asDiagonal() * seen.response.cwiseAbs2();
      expected.push_back((seen.left.cwiseAbs2() + unsure).cwiseSqrt().cast<Complex>());
    }
    noise = noise_of(expected);
  }
  return noise;
}

NoiseDensity equal_noise(const OutputOnly &record, const Eigen::VectorXd &theta)
{
  OutputOnly free = record;
  free.force.level *= no_prior_of_force;
  const auto m = double(record.data.places.size());
  NoiseDensity ones;
  for (const BandRecord &band : record.data.pieces)
    ones.push_back(Eigen::MatrixXd::Ones(band.acceleration.rows(), band.acceleration.cols()));
  std::vector<Eigen::MatrixXcd> left;
  std::size_t piece = 0;
  for (const SeenForce &seen : seen_force(free, theta, ones)) {
    const BandRecord &band = record.data.pieces[piece++];
    // some force explains any course of one sensor; its noise starts from a hundredth of the accelerations
    const Eigen::VectorXd size = m > 1 ? Eigen::VectorXd((seen.left.rowwise().squaredNorm() / (m - 1)).cwiseSqrt())
                                       : Eigen::VectorXd(0.1 * band.acceleration.cwiseAbs().col(0));
    left.push_back(size.cast<Complex>().replicate(1, seen.left.cols()));
  }
  return noise_of(left);
}

Eigen::MatrixXd information_with_force(const OutputOnly &record, const Eigen::VectorXd &theta,
                                       const NoiseDensity &noise)
{
  const SeenStand stand(record, theta);
  const auto p      = Eigen::Index(record.unknowns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(p, p);
  for (std::size_t piece = 0; piece < record.data.pieces.size(); ++piece)
    A += slopes_of(stand, record.data.pieces[piece], noise[piece],
                   Eigen::VectorXd::Zero(2 * stand.modes.frequency.size()), 1, true)
             .with_force;
  return A;
}
}  // namespace mill::twin
