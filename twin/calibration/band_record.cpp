#include "twin/calibration/band_record.h"
#include "core/base/require.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
double sinc_of(const double w, const double step)
{
  const double half = 0.5 * w * step;
  return half > 0 ? std::sin(half) / half : 1;
}

BandRecord band_record(const Eigen::VectorXd &force, const Eigen::MatrixXd &acceleration, const double rate,
                       const double low, const double high, Fourier &fourier, const BetweenSamples between)
{
  require(force.size() == acceleration.rows() || force.size() == 0, "force and accelerations are of one length");
  const Eigen::Index n     = quick_length(acceleration.rows());
  const double df          = rate / double(n);
  const Eigen::Index first = std::max<Eigen::Index>(1, Eigen::Index(std::ceil(low / df - 1e-9))),
                     last  = std::min<Eigen::Index>(n / 2 - 1, Eigen::Index(std::floor(high / df + 1e-9))),
                     k     = std::max<Eigen::Index>(0, last - first + 1);
  const double scale       = std::sqrt(2 / (rate * double(n)));
  BandRecord band;
  band.duration = double(n) / rate;
  band.angular =
      Eigen::VectorXd::NullaryExpr(k, [&](const Eigen::Index i) { return 2 * M_PI * df * double(first + i); });
  std::vector<double> x;
  std::vector<std::complex<double>> X;
  const auto transform = [&](const auto &samples) {
    const double mean = samples.head(n).mean();  // no bin but the zeroth holds it, and rounding stays small
    x.resize(std::size_t(n));
    for (Eigen::Index i = 0; i < n; ++i)
      x[std::size_t(i)] = samples[i] - mean;
    if (samples.size() >
        n)  // trapezoid: a sum that starts at one end only is off by half a step of the difference
      x[0] = 0.5 * (samples[0] + samples[n]) - mean;
    fourier.forward(x, X);
    return Eigen::VectorXcd::NullaryExpr(k,
                                         [&](const Eigen::Index i) { return scale * X[std::size_t(first + i)]; })
        .eval();
  };
  if (force.size())
    band.force = transform(force);
  if (force.size() && between == BetweenSamples::lines) {
    band.line_step = 1 / rate;
    for (Eigen::Index i = 0; i < k; ++i) {
      const double sinc = sinc_of(band.angular[i], band.line_step);
      band.force[i] *= sinc * sinc;
    }
  }
  band.acceleration.resize(k, acceleration.cols());
  for (Eigen::Index j = 0; j < acceleration.cols(); ++j)
    band.acceleration.col(j) = transform(acceleration.col(j));
  return band;
}
}  // namespace mill::twin
