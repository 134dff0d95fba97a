#include "twin/modes/subspace.h"
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr int first_order = 12, last_order = 40, order_step = 2;
constexpr double same_frequency = 0.01, same_damping = 0.30, same_shape = 0.98, largest_damping = 0.2;
constexpr double same_mode_shape = 0.95;

// R_m = mean of y(k + m) y(k)', m = 1 .. n, channels scaled to the same rms.
std::vector<Eigen::MatrixXd> covariances(const DecimatedRecord &record, const Eigen::VectorXd &scale, const int n)
{
  const Eigen::Index p = scale.size();
  std::vector<Eigen::MatrixXd> R(std::size_t(n + 1), Eigen::MatrixXd::Zero(p, p));
  std::vector<double> count(std::size_t(n + 1), 0.0);
  for (const auto &piece : record.piece) {
    const Eigen::MatrixXd y = scale.cwiseInverse().asDiagonal() * piece;
    for (int m = 1; m <= n && m < y.cols(); ++m) {
      R[std::size_t(m)].noalias() += y.rightCols(y.cols() - m) * y.leftCols(y.cols() - m).transpose();
      count[std::size_t(m)] += double(y.cols() - m);
    }
  }
  for (int m = 1; m <= n; ++m)
    if (count[std::size_t(m)] > 0)
      R[std::size_t(m)] /= count[std::size_t(m)];
  return R;
}

Eigen::VectorXd rms_of(const DecimatedRecord &record)
{
  Eigen::VectorXd square = Eigen::VectorXd::Zero(record.piece.front().rows());
  for (const auto &piece : record.piece)
    square += piece.rowwise().squaredNorm();
  return square.cwiseSqrt().cwiseMax(1e-300);
}

// Observability of the largest order, U S^(1/2) of the block Toeplitz matrix, (42.2), (42.3).
Eigen::MatrixXd observability(const std::vector<Eigen::MatrixXd> &R, const int i)
{
  const Eigen::Index p = R[1].rows(), q = R[1].cols();
  Eigen::MatrixXd T(i * p, i * q);
  for (int r = 0; r < i; ++r)
    for (int c = 0; c < i; ++c)
      T.block(r * p, c * q, p, q) = R[std::size_t(i + r - c)];
  // singular vectors by T T' or T' T: singular values below 1e-8 of the largest are lost, which are noise here
  const bool wide = q >= p;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(wide ? Eigen::MatrixXd(T * T.transpose())
                                                                   : Eigen::MatrixXd(T.transpose() * T));
  const Eigen::Index size = solver.eigenvalues().size(), n = std::min<Eigen::Index>(last_order, size);
  Eigen::MatrixXd O(i * p, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double square    = std::max(0.0, solver.eigenvalues()[size - 1 - k]);
    const auto vector      = solver.eigenvectors().col(size - 1 - k);
    const double root_of_s = std::pow(square, 0.25);
    if (wide)
      O.col(k) = vector * root_of_s;
    else
      O.col(k) = T * vector * (root_of_s > 0 ? 1 / root_of_s : 0.0);  // U = T V / S
  }
  return O;
}

void add_poles(std::vector<SubspacePole> &poles, const Eigen::MatrixXd &O, const int order,
               const Eigen::VectorXd &scale, const double rate, const ModeBand &band)
{
  const Eigen::Index p = scale.size(), rows = O.rows() - p;
  const Eigen::MatrixXd up = O.topLeftCorner(rows, order), down = O.bottomLeftCorner(rows, order);
  const Eigen::MatrixXd A = up.householderQr().solve(down);  // (42.4)
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::MatrixXcd C = O.topLeftCorner(p, order).cast<std::complex<double>>();
  for (int k = 0; k < order; ++k) {
    const std::complex<double> mu = solver.eigenvalues()[k];
    if (!(mu.imag() > 0))
      continue;
    const std::complex<double> lambda = rate * std::log(mu);  // (42.5)
    SubspacePole pole{order, std::abs(lambda) / (2 * M_PI), -lambda.real() / std::abs(lambda),
                      scale.cast<std::complex<double>>().asDiagonal() * (C * solver.eigenvectors().col(k))};
    if (pole.frequency >= band.low && pole.frequency <= band.high && pole.damping > 0 &&
        pole.damping < largest_damping)
      poles.push_back(std::move(pole));
  }
}

void mark_stable(std::vector<SubspacePole> &poles)
{
  for (SubspacePole &pole : poles)
    pole.stable = std::any_of(poles.begin(), poles.end(), [&](const SubspacePole &before) {
      return before.order == pole.order - order_step &&
             std::abs(before.frequency / pole.frequency - 1) < same_frequency &&
             std::abs(before.damping / pole.damping - 1) < same_damping &&
             modal_assurance(before.shape, pole.shape) > same_shape;
    });
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

IdentifiedMode mode_of(const std::vector<const SubspacePole *> &cluster, const int orders, const double duration)
{
  std::vector<double> frequency, damping;
  for (const SubspacePole *pole : cluster) {
    frequency.push_back(pole->frequency);
    damping.push_back(pole->damping);
  }
  IdentifiedMode mode{median(frequency), median(damping), {}, orders, false, 0, 0};
  const auto nearest   = *std::min_element(cluster.begin(), cluster.end(), [&](const auto *a, const auto *b) {
    return std::abs(a->frequency - mode.frequency) < std::abs(b->frequency - mode.frequency);
  });
  Eigen::Index largest = 0;
  nearest->shape.cwiseAbs().maxCoeff(&largest);
  mode.shape         = nearest->shape / nearest->shape[largest];
  const double cycle = 2 * M_PI * mode.frequency * duration;
  mode.law_frequency = mode.frequency * std::sqrt(mode.damping / cycle);  // (42.6)
  mode.law_damping   = mode.damping / std::sqrt(mode.damping * cycle);
  return mode;
}
}  // namespace

int block_rows(const double rate, const double low)
{
  return std::min(80, std::max(40, int(std::lround(3 * rate / low))));
}

std::vector<ModeBand> mode_bands(const double highest)
{
  std::vector<ModeBand> bands;
  for (const ModeBand &band : {ModeBand{20, 120}, ModeBand{100, 420}, ModeBand{380, 1000}})
    if (highest > 1.5 * band.low)
      bands.push_back({band.low, std::min(band.high, highest)});
  return bands;
}

double modal_assurance(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b)
{
  const double size = a.squaredNorm() * b.squaredNorm();
  return size > 0 ? std::norm(a.dot(b)) / size : 0;
}

std::vector<SubspacePole> subspace_poles(const DecimatedRecord &record, const ModeBand &band)
{
  std::vector<SubspacePole> poles;
  if (record.piece.empty())
    return poles;
  const int i                 = block_rows(record.rate, band.low);
  const Eigen::VectorXd scale = rms_of(record);
  return poles_of_blocks(covariances(record, scale, 2 * i - 1), i, scale, record.rate, band);
}

std::vector<SubspacePole> poles_of_blocks(const std::vector<Eigen::MatrixXd> &R, const int i,
                                          const Eigen::VectorXd &scale, const double rate, const ModeBand &band)
{
  std::vector<SubspacePole> poles;
  const Eigen::MatrixXd O = observability(R, i);
  for (int order = first_order; order <= std::min<int>(last_order, int(O.cols())); order += order_step)
    add_poles(poles, O, order, scale, rate, band);
  mark_stable(poles);
  return poles;
}

std::vector<IdentifiedMode> modes_of_poles(const std::vector<SubspacePole> &poles, const double duration)
{
  std::vector<const SubspacePole *> stable;
  for (const SubspacePole &pole : poles)
    if (pole.stable)
      stable.push_back(&pole);
  std::sort(stable.begin(), stable.end(), [](const auto *a, const auto *b) {
    return a->order != b->order ? a->order > b->order : a->frequency < b->frequency;
  });
  constexpr int fewest = ((last_order - first_order) / order_step + 1) / 2;
  std::vector<bool> used(stable.size(), false);
  std::vector<IdentifiedMode> modes;
  for (std::size_t i = 0; i < stable.size(); ++i) {
    if (used[i])
      continue;
    std::vector<const SubspacePole *> cluster;
    std::vector<int> orders;
    for (std::size_t k = i; k < stable.size(); ++k)
      if (!used[k] && std::abs(stable[k]->frequency / stable[i]->frequency - 1) < same_frequency &&
          modal_assurance(stable[k]->shape, stable[i]->shape) > same_mode_shape) {
        used[k] = true;
        cluster.push_back(stable[k]);
        if (std::find(orders.begin(), orders.end(), stable[k]->order) == orders.end())
          orders.push_back(stable[k]->order);
      }
    if (int(orders.size()) >= fewest)
      modes.push_back(mode_of(cluster, int(orders.size()), duration));
  }
  std::sort(modes.begin(), modes.end(), [](const auto &a, const auto &b) { return a.frequency < b.frequency; });
  return modes;
}
}  // namespace mill::twin
