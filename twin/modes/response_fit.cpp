#include "twin/modes/response_fit.h"
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

constexpr int most_fit_steps       = 40;
constexpr double bins_per_free_one = 35.0 / 18;  // neighbours of H1 under a Hann window: 1 + 2 (4/9 + 1/36)
constexpr Eigen::Index smoothed    = 4;          // bins to each side
constexpr Eigen::Index of_others   = 6;          // numbers for what other modes add: a parabola, complex

Complex derivative_of_pole(const Complex lambda, const double w, const double length)
{
  const double step = 1e-4 * std::abs(lambda.real()) + 1e-9 * std::abs(lambda);
  return (windowed_pole(lambda + step, w, length) - windowed_pole(lambda - step, w, length)) / (2 * step);
}

// One channel in a fit: H and the weight of each bin, real parts above imaginary ones.
struct Target {
  Eigen::VectorXd value, weight;
};

Eigen::VectorXd stacked(const Eigen::VectorXcd &x)
{
  Eigen::VectorXd both(2 * x.size());
  both << x.real(), x.imag();
  return both;
}

// Weights by the noise that the coherence leaves, smoothed over neighbouring bins.
Target target_of(const ForceResponse &response, const Eigen::Index c, const Eigen::Index first,
                 const Eigen::Index last)
{
  const Eigen::Index n = last - first + 1;
  Eigen::VectorXd noise(n), weight(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double g = std::max(response.coherence(first + k, c), 1e-3);
    noise[k]       = std::norm(response.H(first + k, c)) * (1 - g + 1e-9) / g;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index a = std::max<Eigen::Index>(0, k - smoothed), b = std::min(n - 1, k + smoothed);
    weight[k] = 1 / std::sqrt(noise.segment(a, b - a + 1).mean() + 1e-300);
  }
  Target target;
  target.weight.resize(2 * n);
  target.weight << weight, weight;
  target.value = stacked(response.H.col(c).segment(first, n)).cwiseProduct(target.weight);
  return target;
}

class ResonanceFit {
public:
  ResonanceFit(const ForceResponse &r, const Eigen::Index from, const Eigen::Index to)
      : response(r), first(from), n(to - from + 1)
  {
    for (Eigen::Index c = 0; c < r.H.cols(); ++c)
      targets.push_back(target_of(r, c, from, to));
  }

  // Sum of squares at the poles; with a Jacobian when asked.
  double at(const std::vector<Complex> &poles, Eigen::MatrixXd *jacobian, Eigen::VectorXd *left)
  {
    const auto m = Eigen::Index(poles.size()), p = Eigen::Index(targets.size());
    Eigen::MatrixXd columns(2 * n, 2 * m + of_others);
    std::vector<Eigen::VectorXcd> slope(2 * poles.size(), Eigen::VectorXcd(n));
    fill(poles, columns, jacobian ? &slope : nullptr);
    amplitudes.assign(targets.size(), Eigen::VectorXd());
    if (jacobian)
      jacobian->resize(2 * n * p, 2 * m);
    if (left)
      left->resize(2 * n * p);
    double sum = 0;
    for (Eigen::Index c = 0; c < p; ++c) {
      const Target &target    = targets[std::size_t(c)];
      const Eigen::MatrixXd B = target.weight.asDiagonal() * columns;
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(B);
      const Eigen::VectorXd a = qr.solve(target.value), rest = target.value - B * a;
      amplitudes[std::size_t(c)] = a;
      sum += rest.squaredNorm();
      if (left)
        left->segment(2 * n * c, 2 * n) = rest;
      if (jacobian)
        for (Eigen::Index j = 0; j < 2 * m; ++j)
          jacobian->block(2 * n * c, j, 2 * n, 1) = projected(qr, target, a, j, slope, B.cols());
    }
    return sum;
  }

  std::vector<FittedPole> poles_with_intervals(const std::vector<Complex> &poles)
  {
    const auto m = Eigen::Index(poles.size()), p = Eigen::Index(targets.size());
    Eigen::MatrixXd J;
    const double sum  = at(poles, &J, nullptr);
    const double dof  = double(2 * n * p - (2 * m + of_others) * p - 2 * m);
    const double unit = sum / std::max(1.0, dof) * bins_per_free_one;
    const Eigen::MatrixXd covariance =
        unit * (J.transpose() * J).ldlt().solve(Eigen::MatrixXd::Identity(2 * m, 2 * m));
    std::vector<FittedPole> fitted;
    for (Eigen::Index r = 0; r < m; ++r) {
      FittedPole pole{poles[std::size_t(r)], 0, 0, 0, 0, Eigen::VectorXcd(p), Eigen::VectorXd(p)};
      const double re = pole.lambda.real(), im = pole.lambda.imag(), size = std::abs(pole.lambda);
      pole.frequency = size / (2 * M_PI);
      pole.damping   = -re / size;
      Eigen::Matrix2d slope;  // of |lambda| and of the damping ratio
      slope << re / size, im / size, -im * im / (size * size * size), re * im / (size * size * size);
      const Eigen::Matrix2d of_both = slope * covariance.block<2, 2>(2 * r, 2 * r) * slope.transpose();
      pole.sd_frequency             = std::sqrt(of_both(0, 0)) / (2 * M_PI);
      pole.sd_damping               = std::sqrt(of_both(1, 1));
      for (Eigen::Index c = 0; c < p; ++c)
        pole.residue[c] = {amplitudes[std::size_t(c)][2 * r], amplitudes[std::size_t(c)][2 * r + 1]};
      fitted.push_back(std::move(pole));
    }
    add_deviations_of_residues(poles, unit, fitted);
    return fitted;
  }

private:
  void fill(const std::vector<Complex> &poles, Eigen::MatrixXd &columns,
            std::vector<Eigen::VectorXcd> *slope) const
  {
    const double length = response.length();
    const auto m        = Eigen::Index(poles.size());
    for (Eigen::Index r = 0; r < m; ++r) {
      Eigen::VectorXcd upper(n), lower(n);
      for (Eigen::Index k = 0; k < n; ++k) {
        const double w       = 2 * M_PI * double(first + k) * response.resolution();
        const Complex lambda = poles[std::size_t(r)];
        upper[k]             = windowed_pole(lambda, w, length);
        lower[k]             = windowed_pole(std::conj(lambda), w, length);
        if (slope) {
          (*slope)[std::size_t(2 * r)][k]     = derivative_of_pole(lambda, w, length);
          (*slope)[std::size_t(2 * r + 1)][k] = derivative_of_pole(std::conj(lambda), w, length);
        }
      }
      const Complex i(0, 1);
      columns.col(2 * r)     = stacked(upper + lower);        // real part of the residue
      columns.col(2 * r + 1) = stacked(i * (upper - lower));  // imaginary part
    }
    Eigen::VectorXd power   = Eigen::VectorXd::Ones(n);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1, 1), none = Eigen::VectorXd::Zero(n);
    for (Eigen::Index j = 2 * m; j < 2 * m + of_others; j += 2) {
      columns.col(j) << power, none;
      columns.col(j + 1) << none, power;
      power = power.cwiseProduct(x);
    }
  }

  // Column j of the Jacobian: what moving a pole changes, less what the amplitudes take up of it.
  Eigen::VectorXd projected(const Eigen::HouseholderQR<Eigen::MatrixXd> &qr, const Target &target,
                            const Eigen::VectorXd &a, const Eigen::Index j,
                            const std::vector<Eigen::VectorXcd> &slope, const Eigen::Index rank) const
  {
    const Eigen::Index r = j / 2;
    const Complex amplitude(a[2 * r], a[2 * r + 1]), i(0, 1);
    const Complex by_upper = j % 2 == 0 ? Complex(1, 0) : i, by_lower = std::conj(by_upper);
    const Eigen::VectorXcd moved = amplitude * by_upper * slope[std::size_t(2 * r)] +
                                   std::conj(amplitude) * by_lower * slope[std::size_t(2 * r + 1)];
    Eigen::VectorXd column = qr.householderQ().adjoint() * stacked(moved).cwiseProduct(target.weight);
    column.head(rank).setZero();
    return -(qr.householderQ() * column);
  }

  void add_deviations_of_residues(const std::vector<Complex> &poles, const double unit,
                                  std::vector<FittedPole> &fitted) const
  {
    const auto m = Eigen::Index(poles.size());
    Eigen::MatrixXd columns(2 * n, 2 * m + of_others);
    fill(poles, columns, nullptr);
    for (std::size_t c = 0; c < targets.size(); ++c) {
      const Eigen::MatrixXd B = targets[c].weight.asDiagonal() * columns;
      const Eigen::MatrixXd covariance =
          unit * (B.transpose() * B).ldlt().solve(Eigen::MatrixXd::Identity(B.cols(), B.cols()));
      for (Eigen::Index r = 0; r < m; ++r)
        fitted[std::size_t(r)].sd_residue[Eigen::Index(c)] =
            std::sqrt(std::max(0.0, 0.5 * (covariance(2 * r, 2 * r) + covariance(2 * r + 1, 2 * r + 1))));
    }
  }

  const ForceResponse &response;
  Eigen::Index first, n;
  std::vector<Target> targets;
  std::vector<Eigen::VectorXd> amplitudes;
};

bool inside(const std::vector<Complex> &poles, const double low, const double high)
{
  return std::all_of(poles.begin(), poles.end(), [&](const Complex &pole) {
    return pole.real() < 0 && pole.imag() > 2 * M_PI * low && pole.imag() < 2 * M_PI * high &&
           -pole.real() < 0.3 * std::abs(pole);
  });
}
}  // namespace

std::complex<double> windowed_pole(const std::complex<double> lambda, const double w, const double length)
{
  const Complex s = (lambda - Complex(0, w)) * length;
  // integrals of exp(s u) and (1 - u) exp(s u) over 0 .. 1
  const auto plain = [](const Complex x) {
    return std::abs(x) < 1e-4 ? 1.0 + x / 2.0 + x * x / 6.0 : (std::exp(x) - 1.0) / x;
  };
  const auto falling = [](const Complex x) {
    return std::abs(x) < 1e-3 ? 0.5 + x / 6.0 + x * x / 24.0 + x * x * x / 120.0
                              : (std::exp(x) - 1.0 - x) / (x * x);
  };
  const Complex turn(0, 2 * M_PI), i(0, 1);
  return length * (2.0 / 3 * falling(s) + 1.0 / 6 * (falling(s + turn) + falling(s - turn)) +
                   (plain(s + turn) - plain(s - turn)) / (4 * M_PI * i));
}

std::vector<FittedPole> fit_response(const ForceResponse &response, const std::vector<Complex> &start,
                                     const Eigen::Index first, const Eigen::Index last)
{
  const auto m         = Eigen::Index(start.size());
  const Eigen::Index n = last - first + 1;
  if (m == 0 || n < 4 * m + 8)
    return {};
  const double low = double(first) * response.resolution(), high = double(last) * response.resolution();
  ResonanceFit fit(response, first, last);
  std::vector<Complex> poles = start;
  Eigen::MatrixXd J;
  Eigen::VectorXd left;
  double sum = fit.at(poles, &J, &left), shift = 1e-3;
  for (int step = 0; step < most_fit_steps; ++step) {
    Eigen::MatrixXd A = J.transpose() * J;
    A.diagonal() *= 1 + shift;
    const Eigen::VectorXd d    = A.ldlt().solve(-J.transpose() * left);
    std::vector<Complex> tried = poles;
    for (Eigen::Index r = 0; r < m; ++r)
      tried[std::size_t(r)] += Complex(d[2 * r], d[2 * r + 1]);
    const double better = d.allFinite() && inside(tried, low, high) ? fit.at(tried, nullptr, nullptr)
                                                                    : std::numeric_limits<double>::infinity();
    if (!(better < sum)) {
      shift *= 10;
      if (shift > 1e6)
        break;
      continue;
    }
    const double fall = 1 - better / sum;
    poles             = tried;
    sum               = fit.at(poles, &J, &left);
    shift             = std::max(1e-9, shift / 10);
    if (fall < 1e-10)
      break;
  }
  return inside(poles, low, high) ? fit.poles_with_intervals(poles) : std::vector<FittedPole>();
}
}  // namespace mill::twin
