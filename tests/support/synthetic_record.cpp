#include "tests/support/synthetic_record.h"
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <unsupported/Eigen/FFT>

namespace synthetic {
Eigen::VectorXd uniforms(const std::uint64_t seed, const Eigen::Index n)
{
  Eigen::VectorXd u(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    std::uint64_t z = seed + (std::uint64_t(k) + 1) * 0x9E3779B97F4A7C15ull;
    z               = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z               = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    u[k]            = double((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
  }
  return u;
}

Eigen::VectorXd normals(const std::uint64_t seed, const Eigen::Index n)
{
  const Eigen::Index pairs = (n + 1) / 2;
  const Eigen::VectorXd u  = uniforms(seed, 2 * pairs);
  Eigen::VectorXd x(2 * pairs);
  for (Eigen::Index j = 0; j < pairs; ++j) {
    const double r = std::sqrt(-2 * std::log(1 - u[2 * j])), angle = 2 * M_PI * u[2 * j + 1];
    x[2 * j]     = r * std::cos(angle);
    x[2 * j + 1] = r * std::sin(angle);
  }
  return x.head(n);
}

Eigen::VectorXd white(const std::uint64_t seed, const Eigen::Index n, const double rate, const double density)
{
  return density * std::sqrt(rate / 2) * normals(seed, n);
}

BandForce band_force(const std::uint64_t seed, const Eigen::Index n, const double rate, const double rms,
                     const double low, const double high)
{
  const auto first         = Eigen::Index(std::floor(low * double(n) / rate)) + 1,
             last          = Eigen::Index(std::floor(high * double(n) / rate + 1e-9));
  const Eigen::Index lines = last - first + 1;
  const Eigen::VectorXd ab = normals(seed, 2 * lines);
  std::vector<std::complex<double>> force(std::size_t(n), 0.0), drive(std::size_t(n), 0.0);
  for (Eigen::Index j = 0; j < lines; ++j) {
    const Eigen::Index i = first + j;
    const double x = M_PI * double(i) / double(n), sinc = std::sin(x) / x;
    const std::complex<double> line =
        0.5 * rms / std::sqrt(double(lines)) * std::complex<double>(ab[2 * j], -ab[2 * j + 1]) * double(n);
    force[std::size_t(i)] += line;
    force[std::size_t(n - i)] += std::conj(line);
    drive[std::size_t(i)] += line / (sinc * sinc);
    drive[std::size_t(n - i)] += std::conj(line) / (sinc * sinc);
  }
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> a, b;
  fft.inv(a, force);
  fft.inv(b, drive);
  BandForce result{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    result.force[k] = a[std::size_t(k)].real();
    result.drive[k] = b[std::size_t(k)].real();
  }
  return result;
}

Chain chain(const Eigen::VectorXd &M, const Eigen::VectorXd &K, const double damping)
{
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(6, 6), strain(6, 7);
  for (int j = 0; j < 7; ++j) {  // K1 and K7 stand on the ground
    if (j > 0)
      stiffness(j - 1, j - 1) += K[j];
    if (j < 6)
      stiffness(j, j) += K[j];
    if (j > 0 && j < 6) {
      stiffness(j - 1, j) -= K[j];
      stiffness(j, j - 1) -= K[j];
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness,
                                                                         Eigen::MatrixXd(M.asDiagonal()));
  const Eigen::MatrixXd V = solver.eigenvectors();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 7; ++j) {
      const double stretch = (j < 6 ? V(j, i) : 0) - (j > 0 ? V(j - 1, i) : 0);
      strain(i, j)         = K[j] * stretch * stretch / solver.eigenvalues()[i];
    }
  const Eigen::MatrixXd kinetic = (M.asDiagonal() * V.cwiseAbs2()).transpose();
  return {solver.eigenvalues().cwiseSqrt() / (2 * M_PI), V, strain, kinetic, damping};
}

Eigen::MatrixXd modal_response(const Eigen::VectorXd &frequency, const Eigen::VectorXd &gain, const double z,
                               const Eigen::VectorXd &drive, const double rate)
{
  const Eigen::Index n = drive.size();
  const double h       = 1 / rate;
  Eigen::MatrixXd modal(n, frequency.size());
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const double w = 2 * M_PI * frequency[i], d = w * std::sqrt(1 - z * z), e = std::exp(-z * w * h),
                 c = std::cos(d * h), s = std::sin(d * h);
    double q = gain[i] * drive[0] / (w * w), v = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double f = gain[i] * drive[k];
      modal(k, i)    = f - 2 * z * w * v - w * w * q;
      if (k + 1 == n)
        break;
      const double slope = (gain[i] * drive[k + 1] - f) / h, p0 = f / (w * w) - 2 * z * slope / (w * w * w),
                   pv = slope / (w * w), a = q - p0, b = (v - pv + z * w * a) / d;
      q = e * (a * c + b * s) + p0 + pv * h;
      v = e * ((b * d - z * w * a) * c - (a * d + z * w * b) * s) + pv;
    }
  }
  return modal;
}

Eigen::MatrixXd response(const Chain &chain, const Eigen::VectorXd &drive, const double rate)
{
  const Eigen::VectorXd gain = (chain.shape.row(2) - chain.shape.row(3)).transpose();
  return modal_response(chain.frequency, gain, chain.damping, drive, rate) * chain.shape.transpose();
}

Eigen::VectorXd lines_record(const std::vector<std::array<double, 3>> &lines, const double offset,
                             const double drift, const double density, const std::uint64_t seed,
                             const Eigen::Index n, const double rate)
{
  Eigen::VectorXd x = white(seed, n, rate, density);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = double(k) / rate;
    x[k] += offset + drift * t;
    for (const auto &[f, amplitude, phase] : lines)
      x[k] += amplitude * std::cos(2 * M_PI * f * t + phase);
  }
  return x;
}

Onset onset(const std::uint64_t seed, const Eigen::Index n, const double rate, const double f0, const double rms0,
            const double density, const std::vector<double> &sigma)
{
  // dz = sigma z dt + noise; while sigma = sigma[0] < 0 the mean |z|^2 is 2 rms0^2, so that Re(z exp(iwt)) has
  // rms0
  const double drive         = std::sqrt(2 * rms0 * rms0 * 2 * std::abs(sigma.front()) / rate / 2);
  const Eigen::VectorXd kick = normals(seed, 2 * n + 2), noise = white(seed + 1, n, rate, density);
  Onset result{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  std::complex<double> z(rms0 * kick[2 * n], rms0 * kick[2 * n + 1]);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double phase  = 2 * M_PI * std::fmod(f0 * double(k) / rate, 1.0);
    result.amplitude[k] = std::abs(z);
    result.signal[k]    = (z * std::polar(1.0, phase)).real() + noise[k];
    const double s      = sigma[std::min(std::size_t(k), sigma.size() - 1)];
    z                   = z * std::exp(s / rate) + drive * std::complex<double>(kick[2 * k], kick[2 * k + 1]);
  }
  return result;
}
}  // namespace synthetic
